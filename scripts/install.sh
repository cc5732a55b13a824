# shellcheck shell=bash
# Gets a command what it needs from the machine. Sourced by ./pleat after phase.sh.

node_version=22.23.3

# One line per tool: Debian package, then what shows that it is there: a command, a header <…>, or a file /….
native_tools='
g++ g++
cmake cmake
ninja-build ninja
libeigen3-dev <eigen3/Eigen/Core>
libsuitesparse-dev <suitesparse/cholmod.h>
nlohmann-json3-dev <nlohmann/json.hpp>
libspectra-dev <Spectra/SymEigsShiftSolver.h>'
wasm_tools='
cmake cmake
ninja-build ninja
emscripten emcc
node-acorn /usr/share/nodejs/acorn
libeigen3-dev <eigen3/Eigen/Core>
nlohmann-json3-dev <nlohmann/json.hpp>
libspectra-dev <Spectra/SymEigsShiftSolver.h>
xz-utils xz'
node_tools='
npm npm
ca-certificates /etc/ssl/certs/ca-certificates.crt'
test_tools='
catch2 <catch2/catch.hpp>
clang clang++
libclang-rt-dev /usr/share/doc/libclang-rt-dev
clang-format clang-format
clang-tidy clang-tidy
python3 python3
git git
chromium chromium'

is_there() {
  local header folder
  case $1 in
    '<'*)
      header=${1#<}
      header=${header%>}
      for folder in /usr/include /usr/local/include ${CMAKE_PREFIX_PATH:+"$CMAKE_PREFIX_PATH/include"}; do
        [ ! -e "$folder/$header" ] || return 0
      done
      return 1
      ;;
    /*) [ -e "$1" ] ;;
    *) command -v "$1" >/dev/null ;;
  esac
}

# Packages of the given lists that are not there yet, each once.
missing_packages() {
  printf '%s\n' "$@" | sort -u | while read -r package proof; do
    [ -z "$package" ] || is_there "$proof" || echo "$package"
  done
}

# "$@" is how to become root: nothing, or sudo.
apt_install() {
  local -a packages
  read -r -a packages <<<"$1"
  shift
  "$@" apt-get -o Acquire::Retries=3 update &&
    "$@" env DEBIAN_FRONTEND=noninteractive apt-get -o Acquire::Retries=3 -o DPkg::Lock::Timeout=120 \
      install -y --no-install-recommends "${packages[@]}"
}

# install_tools LIST…: installs what the lists name and the machine lacks, or says what is missing.
install_tools() {
  local missing answer='' by_hand
  local -a as_root=()
  missing=$(missing_packages "$@" | tr '\n' ' ')
  missing=${missing% }
  [ -n "$missing" ] || return 0
  by_hand="Missing here (by their Debian names): $missing."
  command -v apt-get >/dev/null || give_up "$by_hand Install them, then run this again."
  if [ "$(id -u)" -ne 0 ]; then
    by_hand="$by_hand Install them with: sudo apt-get install $missing"
    command -v sudo >/dev/null || give_up "$by_hand"
    as_root=(sudo -n)
    if [ -t 0 ] && [ "${CI:-}" != true ]; then
      read -r -p "Install $missing with sudo apt-get? [Y/n] " answer
      case $answer in [nN]*) give_up "$by_hand" ;; esac
      as_root=(sudo)
      sudo -v || give_up "$by_hand"
    fi
  fi
  say "Missing here: $missing"
  phase install "Install Debian packages" apt_install "$missing" "${as_root[@]}" || give_up "$by_hand"
}

fetch_node() {
  rm -rf .tools/node_modules
  npm install --prefix .tools --no-audit --no-fund --no-package-lock "node@$node_version"
}

# Debian 12 has Node 18; the page's tools want 22, and their native parts are chosen by the Node that installs them.
use_node() {
  local bin=$root/.tools/node_modules/node/bin
  if [ "$("$bin/node" --version 2>/dev/null)" != "v$node_version" ]; then
    phase node "Install Node $node_version into .tools" fetch_node || return 1
  fi
  PATH=$bin:$PATH
}

fetch_page_packages() {
  cd web && npm install --no-save --no-audit --no-fund && echo "$1" >node_modules/.installed-from
}

install_page_packages() {
  local wanted
  wanted=$(cat "$root"/web/package.json "$root"/web/package-lock.json 2>/dev/null | cksum)
  [ "$(cat "$root/web/node_modules/.installed-from" 2>/dev/null)" != "$wanted $node_version" ] || return 0
  phase page-packages "Install the page's packages" fetch_page_packages "$wanted $node_version"
}

fetch_suitesparse() {
  scripts/fetch-suitesparse.sh third_party/suitesparse && return
  [ "$(id -u)" -eq 0 ] && apt-get update && scripts/fetch-suitesparse.sh third_party/suitesparse
}

# SuiteSparse is not needed: else the WebAssembly build uses Eigen's Cholesky, and the page says so.
install_suitesparse() {
  [ ! -d "$root/third_party/suitesparse/src" ] || return 0
  phase suitesparse "Fetch SuiteSparse's source" fetch_suitesparse
}
