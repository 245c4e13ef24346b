# Shared by the scripts here: where the project is, and the Debian packages it needs. Sourced, not run.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

# What building, running and testing need on a fresh Debian 12.
packages=(
  g++ cmake ninja-build pkg-config
  libglm-dev libglfw3-dev libtinygltf-dev python3-glad libegl-dev libgl-dev libpng-dev libturbojpeg0-dev libimgui-dev
  libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libgtest-dev libbenchmark-dev
  libegl1 libegl-mesa0 libgl1 libglx-mesa0 libgl1-mesa-dri
  libx11-dev ffmpeg xvfb python3 python3-numpy imagemagick
)
lint_packages=(clang-format clang-tidy)
model_packages=(blender python3-numpy)

say() { printf '%s\n' "$*"; }
die() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; exit 1; }

# ensure_packages NAME...: installs what is missing, or names it when that is not allowed.
ensure_packages() {
  local missing=() p
  for p in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$p" 2>/dev/null || true)" = installed ] || missing+=("$p")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null && sudo -n true 2>/dev/null && sudo=(sudo -n) ||
      die "these packages are missing, and installing them is not allowed to this user: ${missing[*]}
  install them with: sudo apt-get install ${missing[*]}"
  fi
  say "Installing: ${missing[*]}"
  local log; log=$(mktemp)
  if ! { "${sudo[@]}" apt-get update -qq && DEBIAN_FRONTEND=noninteractive "${sudo[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -n 15 "$log" >&2
    die "apt-get could not install: ${missing[*]}"
  fi
  rm -f "$log"
}

# build_preset NAME [TESTS [TARGET...]]: configures (when needed) and builds these targets, or all, of the test programs those of a ;-list, or all.
build_preset() {
  case "$1" in debug | release | asan | tsan) ;; *) die "no preset '$1'; there are debug, release, asan, tsan" ;; esac
  cmake --preset "$1" -DRG_TESTS="${2:-}" >"/tmp/rainglass-configure.$$" 2>&1 || { cat "/tmp/rainglass-configure.$$" >&2; rm -f "/tmp/rainglass-configure.$$"; die "configuring $1 failed"; }
  rm -f "/tmp/rainglass-configure.$$"
  cmake --build --preset "$1" ${3:+--target "${@:3}"}
}

# Software GL re-allocates its tile buffers every frame; kept in the heap they cost nothing.
export MALLOC_TRIM_THRESHOLD_=2000000000 MALLOC_MMAP_THRESHOLD_=2000000000
