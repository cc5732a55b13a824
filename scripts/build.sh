# shellcheck shell=bash
# Builds. Sourced by ./pleat after phase.sh. Each one runs in the repository and repeats cheaply.

# One compiler for each core: Ninja's own choice of two more costs a fifth in caches.
build_preset() {
  local preset=$1
  shift
  cmake --preset "$preset" && cmake --build --preset "$preset" -j "$(nproc)" ${1+--target "$@"}
}

# The page and its tests take the module's parts from web/src/wasm; an unchanged one keeps its date.
build_wasm() {
  local file
  build_preset wasm && mkdir -p web/src/wasm || return 1
  for file in pleat{.mjs,.wasm,-rest.wasm}; do
    cmp -s "build/wasm/wasm/$file" "web/src/wasm/$file" ||
      cp "build/wasm/wasm/$file" "web/src/wasm/$file" || return 1
  done
}

page() { cd web && npm run --silent "$@"; }
