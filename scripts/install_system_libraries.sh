#!/usr/bin/env bash
# Makes sure that MuJoCo can draw without a display and that LeRobot's fast video decoder finds
# FFmpeg's libraries: tries both, and where one does not work, installs Mesa's software renderer or
# FFmpeg with apt-get if that is allowed, else prints the command to type. Only drawing is a must:
# without FFmpeg's libraries LeRobot decodes with PyAV, which takes longer and cannot stream.
# Usage: install_system_libraries.sh PYTHON
set -euo pipefail
python=$1
opengl="libegl1 libgl1 libgl1-mesa-dri"
ffmpeg="ffmpeg"

draws_headless() {
    MUJOCO_GL=egl "$python" -c 'import mujoco; mujoco.GLContext(8, 8).make_current()'
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
        as_root apt-get update -qq && as_root apt-get install -qq -y --no-upgrade --no-install-recommends $1 || true
    fi
}

if [[ $(uname) != Linux ]]; then
    exit 0
fi

draws_headless 2>/dev/null || install "$opengl"
if ! reason=$(draws_headless 2>&1); then
    echo "MuJoCo cannot draw without a display: ${reason##*$'\n'}" >&2
    echo "Install headless OpenGL (elsewhere than on Debian and Ubuntu: Mesa with EGL), then repeat the make command:" >&2
    echo "    sudo apt-get update && sudo apt-get install -y $opengl" >&2
    exit 1
fi

decodes 2>/dev/null || install "$ffmpeg"
if ! decodes 2>/dev/null; then
    echo "FFmpeg's libraries are missing: LeRobot decodes videos with PyAV, which takes longer. To have them:" >&2
    echo "    sudo apt-get update && sudo apt-get install -y $ffmpeg" >&2
fi
