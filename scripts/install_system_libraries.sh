#!/usr/bin/env bash
# Makes sure that MuJoCo can draw without a display, with OpenGL or with Vulkan, and that LeRobot's
# fast video decoder finds FFmpeg's libraries: tries what is asked for, and where it does not work,
# installs Mesa's software renderers or FFmpeg with apt-get if that is allowed, else prints the
# command to type. Only OpenGL is a must: without Vulkan there is no renderer=filament, and without
# FFmpeg's libraries LeRobot decodes with PyAV, which takes longer and cannot stream.
# Usage: install_system_libraries.sh PYTHON [opengl] [ffmpeg] [vulkan]
set -euo pipefail
python=$1
wanted=" ${*:2} "
opengl="libegl1 libgl1 libgl1-mesa-dri"
vulkan="libvulkan1 mesa-vulkan-drivers"
ffmpeg="ffmpeg"

draws_headless() {
    MUJOCO_GL=egl "$python" -c 'import mujoco; mujoco.GLContext(8, 8).make_current()'
}

finds_vulkan() {
    "$python" -c 'from labutopia_lerobot.sim.vulkan import vulkan_device; raise SystemExit(vulkan_device() is None)'
}

decodes() {
    "$python" -c 'import torchcodec.decoders'
}

as_root() {
    if ((EUID == 0)); then "$@"; else sudo -n "$@"; fi
}

install() {
    if command -v apt-get >/dev/null && as_root true 2>/dev/null; then
        echo "Installing $1"
        # shellcheck disable=SC2086  # the list is meant to be split
        as_root apt-get update -qq && as_root apt-get install -qq -y --no-upgrade --no-install-recommends $1 >/dev/null || true
    fi
}

if [[ $(uname) != Linux ]]; then
    exit 0
fi

asked_for() {
    [[ $wanted == *" $1 "* ]]
}

asked_for opengl && ! draws_headless 2>/dev/null && install "$opengl"
if asked_for opengl && ! reason=$(draws_headless 2>&1); then
    echo "MuJoCo cannot draw without a display: ${reason##*$'\n'}" >&2
    echo "Install headless OpenGL (elsewhere than on Debian and Ubuntu: Mesa with EGL), then repeat the make command:" >&2
    echo "    sudo apt-get update && sudo apt-get install -y $opengl" >&2
    exit 1
fi

asked_for vulkan && ! finds_vulkan 2>/dev/null && install "$vulkan"
if asked_for vulkan && ! finds_vulkan 2>/dev/null; then
    echo "There is no Vulkan: renderer=filament and its tests are left out. To have them:" >&2
    echo "    sudo apt-get update && sudo apt-get install -y $vulkan" >&2
fi

asked_for ffmpeg && ! decodes 2>/dev/null && install "$ffmpeg"
if asked_for ffmpeg && ! decodes 2>/dev/null; then
    echo "FFmpeg's libraries are missing: LeRobot decodes videos with PyAV, which takes longer. To have them:" >&2
    echo "    sudo apt-get update && sudo apt-get install -y $ffmpeg" >&2
fi
