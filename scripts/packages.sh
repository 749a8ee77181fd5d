# shellcheck shell=bash
# The Debian packages poselift needs, in one place, and how to get them.
# Sourced by demo.sh and test.sh.

# To configure and build everything: the program, the tests, the benchmarks.
# shellcheck disable=SC2034  # used by the scripts that source this
build_packages=(
  g++ cmake ninja-build
  libeigen3-dev libceres-dev
  libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-videoio-dev
  libopencv-video-dev libopencv-calib3d-dev
  libapriltag-dev libtomlplusplus-dev libyaml-cpp-dev libcairo2-dev libturbojpeg0-dev
  libexif-dev libavformat-dev pkg-config
  libcli11-dev nlohmann-json3-dev libfmt-dev libspdlog-dev zlib1g-dev libhnswlib-dev
  qt6-base-dev fonts-dejavu-core
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev
)
# For the checks of scripts/check.sh.
# shellcheck disable=SC2034
check_packages=(clang-format-14 codespell shellcheck)
# Without them some tests are skipped: Blender (393 MB) reads our files back; a virtual machine
# has cameras for capture, fed by ffmpeg; a screen in memory shows the window.
# shellcheck disable=SC2034
optional_test_packages=(
  blender poppler-utils
  qemu-system-x86 busybox-static cpio kmod make v4l-utils ffmpeg
  xvfb xdotool
)

say() { printf '\n==> %s\n' "$*"; }

missing_packages() {
  local package
  for package in "$@"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      echo "$package"
  done
}

# install_packages NAME...: asks apt only for what is missing; silent when nothing is.
install_packages() {
  [[ "${POSELIFT_NO_INSTALL:-}" == 1 ]] && return 0
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    cat >&2 <<TEXT
This script installs Debian packages, and this system has no apt-get. Install what
these packages hold by other means (poselift is built and tested on Debian 12):
  $*
then run it again with POSELIFT_NO_INSTALL=1.
TEXT
    return 1
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  say "installing ${missing[*]} (minutes, on a fresh machine)"
  local as_root=(env DEBIAN_FRONTEND=noninteractive)
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "Run this as root, or install sudo, or: apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo env DEBIAN_FRONTEND=noninteractive)
    [[ -t 0 ]] || as_root=(sudo -n env DEBIAN_FRONTEND=noninteractive)
  fi
  local apt=("${as_root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
  local log
  log=$(mktemp)
  # A foreign source that fails to update must not stop the installation.
  "${apt[@]}" update </dev/null >"$log" 2>&1 || cat "$log" >&2
  if ! "${apt[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
}

# build_release TARGET...: configures and builds into build/.
build_release() {
  say "building into build/"
  # Takes effect at the first configuration.
  if command -v ccache >/dev/null; then export CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
  cmake --preset release --log-level=WARNING
  cmake --build --preset release --parallel "$(nproc)" --target "$@"
}
