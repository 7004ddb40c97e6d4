"""`labutopia-film`: films of each kind, the same bytes twice, and mistakes that cost nothing."""

import hashlib
from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image

from labutopia_lerobot.cli import film
from labutopia_lerobot.runtime.film import FilmWriter
from labutopia_lerobot.sim.vulkan import vulkan_device

SMALL = ("width=64", "height=36", "fps=2", "exposures=2")
needs_vulkan = pytest.mark.skipif(vulkan_device() is None, reason="there is no Vulkan")


def digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


@pytest.mark.slow
@pytest.mark.parametrize("renderer", ["classic", pytest.param("filament", marks=needs_vulkan)])
def test_the_same_command_gives_the_same_bytes_and_another_seed_others(tmp_path, capsys, renderer):
    for name, seed in (("a", 0), ("b", 0), ("c", 1)):
        out = f"out={tmp_path / name}.webp"
        film.main(["level1/pick", *SMALL, f"seed={seed}", f"renderer={renderer}", out])
    said = capsys.readouterr()
    assert "level1/pick, seed 0: success. Wrote " in said.out
    assert "Setting up level1/pick, seed 0 ..." in said.err
    first, again, other = (digest(tmp_path / f"{name}.webp") for name in "abc")
    assert first == again != other
    with Image.open(tmp_path / "a.webp") as shown:
        assert shown.size == (64, 36)
        assert shown.n_frames > 5


@pytest.mark.parametrize("kind", ["mp4", "webp", "gif"])
def test_a_film_has_every_picture_for_its_time(tmp_path, kind):
    file = tmp_path / f"film.{kind}"
    with FilmWriter(file, 64, 32, rate=10) as writer:
        for number in range(12):
            picture = np.zeros((32, 64, 3), np.uint8)
            picture[:, : 5 * (number + 1)] = (200, 100, 20)
            writer.add(picture)
    assert [each.name for each in tmp_path.iterdir()] == [file.name]
    if kind == "mp4":
        with av.open(str(file)) as container:
            assert sum(1 for _ in container.decode(video=0)) == 12
            assert container.duration == 1_200_000  # microseconds
        return
    with Image.open(file) as film_:
        assert film_.n_frames == 12
        times = []
        for number in range(12):
            film_.seek(number)
            lit = np.asarray(film_.convert("RGB"))[16, :, 0] > 100
            assert abs(int(lit.sum()) - 5 * (number + 1)) <= 3
            times.append(film_.info["duration"])
    assert times == [100] * 12


def test_a_film_that_is_cut_short_leaves_the_one_that_was_there(tmp_path):
    file = tmp_path / "film.mp4"
    file.write_bytes(b"the old one")

    def film_until_interrupted():
        with FilmWriter(file, 64, 32, rate=10) as writer:
            writer.add(np.zeros((32, 64, 3), np.uint8))
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        film_until_interrupted()
    assert [each.name for each in tmp_path.iterdir()] == [file.name]
    assert file.read_bytes() == b"the old one"


@pytest.mark.parametrize(
    ("words", "cure"),
    [
        (["out=film.avi"], "'film.avi' is no film: choose a name that ends with .mp4, .webp, .gif"),
        (["out=film.mp4", "width=63"], "width=63 cannot be filmed"),
        (["out=film.mp4", "camera=side"], "Choose from: beauty, front, top, wrist"),
        (["out=film.mp4", "fps=24"], "fps=24 is unknown. Choose from: 1, 2, 3, 5, 6, 10, 15, 30"),
        (["out=film.mp4", "exposures=0"], "exposures is a whole number from 1 to 256"),
        (["out=/proc/x/film.mp4"], "/proc/x cannot be made a folder"),
    ],
)
def test_a_mistake_is_reported_before_anything_is_played(
    tmp_path, monkeypatch, capsys, words, cure
):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit, match="2"):
        film.main(["level1/pick", "renderer=classic", *words])
    assert cure in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
