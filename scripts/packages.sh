# Sourced by the other scripts: system packages, installed where that is possible and named where it is not.

# can_install: whether packages can be installed here without asking anybody.
can_install() { [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; }

has_library() { { ldconfig -p || /sbin/ldconfig -p; } 2>/dev/null | grep -q "^[[:space:]]*$1"; }

has_vulkan() { ls /usr/share/vulkan/icd.d/*.json /etc/vulkan/icd.d/*.json >/dev/null 2>&1 && has_library libvulkan.so.1; }

# ensure WHY PACKAGE...: installs the packages, or says that they are missing and goes on.
ensure() {
  local why=$1; shift
  if [ $# = 0 ]; then return 0; fi
  if can_install; then
    echo "Installing $* ($why)"
    export DEBIAN_FRONTEND=noninteractive
    if apt-get update -q >/dev/null 2>&1 && apt-get install -y -q --no-install-recommends "$@" >/dev/null 2>&1; then return 0; fi
  fi
  echo "Not installed: $* ($why). On Debian or Ubuntu: sudo apt-get install --no-install-recommends $*" >&2
}

# window_libraries: what the window opens at run time, so that no linker knows it, and the Debian package that has it.
window_libraries() {
  cat <<'LIBRARIES'
libEGL.so.1 libegl1
libxkbcommon-x11.so.0 libxkbcommon-x11-0
libXcursor.so.1 libxcursor1
libXi.so.6 libxi6
libX11-xcb.so.1 libx11-xcb1
LIBRARIES
}

# need_rust COMPONENT...: the toolchain and these parts of it.
need_rust() {
  if ! command -v cargo >/dev/null && [ -x "$HOME/.cargo/bin/cargo" ]; then PATH=$HOME/.cargo/bin:$PATH; fi
  if ! command -v cargo >/dev/null; then
    echo "Rust is missing: install it from https://rustup.rs and run this again." >&2
    exit 1
  fi
  if ! command -v cc >/dev/null; then ensure "linker" gcc libc6-dev; fi
  local part
  for part in "$@"; do
    if ! cargo "$part" --version >/dev/null 2>&1; then
      case $part in fmt) part=rustfmt ;; esac
      echo "The Rust toolchain has no $part: run \`rustup component add $part\` and run this again." >&2
      exit 1
    fi
  done
}
