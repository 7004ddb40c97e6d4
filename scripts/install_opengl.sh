#!/usr/bin/env bash
# Makes sure that MuJoCo can draw without a display: tries it, and where it cannot, installs Mesa's
# software renderer with apt-get if that is allowed, else prints the command to type.
# Usage: install_opengl.sh PYTHON
set -euo pipefail
python=$1
packages="libegl1 libgl1 libgl1-mesa-dri"

draws_headless() {
    MUJOCO_GL=egl "$python" -c 'import mujoco; mujoco.GLContext(8, 8).make_current()'
}

as_root() {
    if ((EUID == 0)); then "$@"; else sudo -n "$@"; fi
}

if [[ $(uname) != Linux ]] || draws_headless 2>/dev/null; then
    exit 0
fi

if command -v apt-get >/dev/null && as_root true 2>/dev/null; then
    echo "Installing headless OpenGL: $packages"
    # shellcheck disable=SC2086  # the list is meant to be split
    as_root apt-get update -qq && as_root apt-get install -qq -y --no-upgrade --no-install-recommends $packages || true
fi

if ! reason=$(draws_headless 2>&1); then
    echo "MuJoCo cannot draw without a display: ${reason##*$'\n'}" >&2
    echo "Install headless OpenGL (elsewhere than on Debian and Ubuntu: Mesa with EGL), then repeat the make command:" >&2
    echo "    sudo apt-get update && sudo apt-get install -y $packages" >&2
    exit 1
fi
