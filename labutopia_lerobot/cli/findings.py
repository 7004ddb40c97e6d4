"""What `labutopia-doctor` finds on a machine: what is there, what is missing or slow, the cure.

Each function looks at one thing and returns what it found. Nothing is installed or changed.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from labutopia_lerobot.errors import UserError
from labutopia_lerobot.kernel import user_cache
from labutopia_lerobot.setting import CLASSIC
from labutopia_lerobot.sim.renderers import renderer_name
from labutopia_lerobot.sim.viewer import has_display
from labutopia_lerobot.sim.vulkan import vulkan_device

GOOD, SLOW, OPTIONAL, MISSING = "good", "slow", "optional", "missing"
"""As it should be; works, but slowly; only some things need it; nothing goes without it."""

NEEDED = ("mujoco", "lerobot", "torch", "gymnasium", "numpy", "numba")
"""Packages whose versions are listed."""
_EXTRAS = {"convert": "h5py", "ray": "ray", "rerun": "rerun", "usd": "pxr", "vla": "peft"}
"""Extra -> a module that it brings."""
_SOFTWARE = ("llvmpipe", "softpipe", "swrast", "software")
"""Words in the names of devices that are no graphics cards."""
_SHARED_MB = 512
"""Shared memory below which PyTorch's loaders end with a bus error now and then (Docker's default
is 64 MB; ours)."""
_DISK_GB = 5
"""Room on the disk below which a recording of the paper's size may not fit: 100 episodes with three
cameras take about 0.1 GB, the checkpoints of a training the rest (ours)."""
_BUSY = 1.5
"""Load per core from which others take a good part of the machine (ours)."""
_QUOTA = Path("/sys/fs/cgroup/cpu.max")
"""Where Linux says how much of its cores a container gets."""


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at.

    Attributes:
        about: Name of it.
        state: `GOOD`, `SLOW`, `OPTIONAL` or `MISSING`.
        found: The facts.
        cure: What to type or to set, empty where nothing is to be done.
    """

    about: str
    state: str
    found: str
    cure: str = ""

    def row(self) -> dict[str, str]:
        """Return it by the names of its fields."""
        return asdict(self)


def findings() -> Iterator[Finding]:
    """Look at everything, one thing after the other."""
    looks: tuple[Callable[[], Finding], ...] = (
        packages,
        extras,
        opengl,
        vulkan,
        graphics_card,
        lambda: threads(os.environ, cores(), granted_cores(), os.getloadavg()[0]),
        kernels,
        video,
        display,
        lambda: shared_memory(_free(Path("/dev/shm")) / 1e6),
        lambda: disk(_free(Path()) / 1e9),
    )
    for look in looks:
        yield look()


def packages() -> Finding:
    """Look whether everything that is needed is installed."""
    versions = {name: _version(name) for name in ("lerobot_env_labutopia", *NEEDED)}
    there = ", ".join(f"{name} {number}" for name, number in versions.items() if number)
    gone = [name for name, number in versions.items() if number is None]
    python = ".".join(map(str, sys.version_info[:3]))
    if gone:
        cure = "pip install -c constraints.txt . in the repository, or make setup"
        return Finding("packages", MISSING, f"not installed: {', '.join(gone)}", cure)
    return Finding("packages", GOOD, f"Python {python}, {there}")


def extras() -> Finding:
    """Look which of the optional packages are installed."""
    gone = [extra for extra, module in _EXTRAS.items() if find_spec(module) is None]
    if not gone:
        return Finding("extras", GOOD, ", ".join(_EXTRAS))
    cure = f"where they are wanted: pip install -c constraints.txt '.[{','.join(gone)}]'"
    return Finding("extras", OPTIONAL, f"not installed: {', '.join(gone)}", cure)


def opengl() -> Finding:
    """Look what draws `renderer=classic`."""
    backend = os.environ.get("MUJOCO_GL") or "MuJoCo's choice"
    try:
        name = renderer_name(CLASSIC)
    except UserError as error:
        found, *lines = str(error).splitlines()
        return Finding("OpenGL", MISSING, found, " ".join(line.strip() for line in lines))
    found = f"{name} ({backend})"
    if not _is_software(name):
        return Finding("OpenGL", GOOD, found)
    cure = (
        "drawing takes most of the time of pictures; where there is a card, install its driver "
        "with EGL (NVIDIA: libnvidia-gl) and set MUJOCO_GL=egl. Without one: obs=state draws "
        "nothing, fewer cameras and smaller pictures less"
    )
    return Finding("OpenGL", SLOW, f"{found}, in software", cure)


def vulkan() -> Finding:
    """Look what draws `renderer=filament`, which films are made with."""
    device = vulkan_device()
    if device is None:
        cure = "for renderer=filament, films: apt-get install libvulkan1 mesa-vulkan-drivers"
        return Finding("Vulkan", OPTIONAL, "none", cure)
    return Finding("Vulkan", GOOD, device)


def graphics_card() -> Finding:
    """Look what PyTorch trains on."""
    import torch  # here: it takes seconds

    if torch.cuda.is_available():
        return Finding("training", GOOD, torch.cuda.get_device_name())
    if shutil.which("nvidia-smi") and _runs("nvidia-smi"):
        cure = (
            "the PyTorch that is installed does not see the card: take a build for it, pytorch.org"
        )
        return Finding("training", SLOW, f"PyTorch {torch.__version__} on the CPU", cure)
    cure = "policies on obs=state train in minutes; those on pictures need a GPU"
    return Finding("training", SLOW, f"PyTorch {torch.__version__} on the CPU, no GPU", cure)


def threads(environment: Mapping[str, str], seen: int, granted: float, load: float) -> Finding:
    """Look whether threads get in each other's way.

    Args:
        environment: The environment variables.
        seen: Cores that this process may run on.
        granted: Of how many it gets the time.
        load: Processes that have wanted to run, on average over the last minute.
    """
    wrong = []
    if granted < 0.9 * seen:
        wrong.append(
            f"the container gets the time of {granted:g} of {seen} cores, and programs see all: "
            f"start it with --cpuset-cpus, or set OMP_NUM_THREADS={max(1, int(granted))} and "
            f"workers={max(1, int(granted))}"
        )
    if environment.get("LP_NUM_THREADS", "1") != "1":
        wrong.append("LP_NUM_THREADS is set: each worker draws with so many threads; unset it")
    if environment.get("OMP_WAIT_POLICY", "").upper() != "PASSIVE" and load > _BUSY * seen:
        wrong.append(
            "others keep the machine busy, and threads that wait for each other spin: "
            "export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=PASSIVE"
        )
    elif load > _BUSY * seen:
        wrong.append("others keep the machine busy: nothing measured now is worth much")
    found = f"{seen} cores, load {load:.1f}"
    names = ("OMP_NUM_THREADS", "OMP_WAIT_POLICY", "LP_NUM_THREADS")
    found += "".join(f", {name}={environment[name]}" for name in names if name in environment)
    return Finding("threads", SLOW if wrong else GOOD, found, "; ".join(wrong))


def kernels() -> Finding:
    """Look whether kernels of the liquid can be kept."""
    folder = user_cache()
    if not _can_write(folder):
        cure = "each process compiles for half a minute; set XDG_CACHE_HOME to a folder of yours"
        return Finding("kernels", SLOW, f"{folder} cannot be written", cure)
    compiled = any((folder / "kernels").rglob("*.nbi"))
    note = "compiled" if compiled else "not yet compiled: the first liquid takes half a minute more"
    return Finding("kernels", GOOD, f"{folder}, {note}")


def video() -> Finding:
    """Look whether LeRobot's fast decoder works."""
    try:
        import torchcodec.decoders  # noqa: F401  # it loads FFmpeg's libraries
    except (ImportError, OSError, RuntimeError):
        cure = "LeRobot decodes with PyAV, which takes longer: apt-get install ffmpeg"
        return Finding("video", SLOW, "torchcodec does not find FFmpeg's libraries", cure)
    return Finding("video", GOOD, "torchcodec")


def display() -> Finding:
    """Look whether a window can be opened."""
    if has_display():
        return Finding("display", GOOD, "labutopia-view opens a window")
    return Finding(
        "display",
        OPTIONAL,
        "none",
        "labutopia-view TASK --web shows it in a browser, or writes files",
    )


def shared_memory(free_mb: float) -> Finding:
    """Look whether PyTorch's loaders have room between processes.

    Args:
        free_mb: Room in `/dev/shm` [MB].
    """
    found = f"{free_mb:,.0f} MB free in /dev/shm"
    if free_mb < _SHARED_MB:
        cure = "trainings may end with a bus error: docker run --shm-size=2g, or --num_workers=0"
        return Finding("shared memory", SLOW, found, cure)
    return Finding("shared memory", GOOD, found)


def disk(free_gb: float) -> Finding:
    """Look whether recordings and checkpoints have room here.

    Args:
        free_gb: Room in the folder of the moment [GB].
    """
    found = f"{free_gb:,.0f} GB free in this folder"
    if free_gb < _DISK_GB:
        return Finding("disk", SLOW, found, "make room, or write elsewhere: root=, out=")
    return Finding("disk", GOOD, found)


def cores() -> int:
    """Return how many cores this process may run on."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def granted_cores(file: Path = _QUOTA) -> float:
    """Return of how many cores a container gets the time; all, where nothing limits it."""
    try:
        quota, period = file.read_text().split()
        return cores() if quota == "max" else int(quota) / int(period)
    except (OSError, ValueError):
        return cores()


def _is_software(name: str) -> bool:
    return any(word in name.lower() for word in _SOFTWARE)


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _runs(program: str) -> bool:
    try:
        return (
            subprocess.run([program], capture_output=True, timeout=20, check=False).returncode == 0
        )
    except (OSError, subprocess.TimeoutExpired):
        return False


def _can_write(folder: Path) -> bool:
    """Return whether a folder can be written into, or made."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    return folder.is_dir() and os.access(folder, os.W_OK | os.X_OK)


def _free(folder: Path) -> float:
    """Return the room in a folder [bytes]; infinite where that cannot be known."""
    try:
        return float(shutil.disk_usage(folder).free)
    except OSError:
        return float("inf")
