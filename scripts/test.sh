# shellcheck shell=bash
# ./pleat test and ./pleat tidy. Sourced by ./pleat after phase.sh, install.sh and build.sh.

cpp_files() { git ls-files -- 'core/*.h' 'core/*.cpp' 'cli/*.h' 'cli/*.cpp' 'wasm/*.h' 'wasm/*.cpp' \
  'native-tests/*.h' 'native-tests/*.cpp'; }

check_format() { cpp_files | xargs -r clang-format --dry-run -Werror; }

check_layers() {
  python3 native-tests/check_layers.py --self-test && python3 native-tests/check_layers.py
}

# The commit the changes are counted from: where this branch left its upstream, else the commit before.
change_base() {
  local base
  base=$(git merge-base HEAD '@{upstream}' 2>/dev/null)
  if [ -z "$base" ] || [ "$base" = "$(git rev-parse HEAD)" ]; then
    base=$(git rev-parse --verify --quiet HEAD~1)
  fi
  echo "$base"
}

changed_files() {
  local base
  base=$(change_base)
  [ -z "$base" ] || git diff --name-only --diff-filter=d "$base"
  git ls-files --others --exclude-standard
}

# Sources the native build compiles; a changed header is checked through the source beside it.
tidy_sources() {
  sed -n 's/\.h$/.cpp/p; /\.cpp$/p' | sort -u | while read -r source; do
    if grep -qF "$root/$source\"" build/release/compile_commands.json; then echo "$source"; fi
  done
}

# tidy LIST: clang-tidy over the files the command LIST names, one process per core.
tidy() {
  "$1" | tidy_sources | tee /dev/stderr |
    xargs -r -n 1 -P "$(nproc)" clang-tidy -p build/release --quiet
}

# run_native_tests PRESET [SELECTION]: all tests, or those that Catch2's SELECTION names.
run_native_tests() { "build/$1/native-tests/pleat_tests" --use-colour no "${@:2}"; }

test_native() {
  step release-build "Build, Release" build_preset release &&
    suite read_catch2 release-tests "Test, Release" run_native_tests release
  step dev-build "Build with sanitizers" build_preset dev &&
    # Long motions walk the same code as short ones, twenty times slower here.
    suite read_catch2 dev-tests "Test with sanitizers" run_native_tests dev '~[long]'
  [ ! -f "$root/build/release/compile_commands.json" ] ||
    check tidy "Tidy what changed" tidy changed_files
}

test_wasm_build() {
  install_suitesparse || failed=$((failed + 1))
  step wasm-build "Build WebAssembly" build_wasm
}

test_page() {
  if ! use_node || ! install_page_packages; then
    failed=$((failed + 1))
    return 1
  fi
  check biome "Check the page's format (Biome)" page lint
  check tsc "Check the page's types (tsc)" page typecheck
  suite read_vitest vitest "Test the page's parts and WebAssembly" page test
  step page-build "Build the page" page build &&
    suite read_summary e2e "Test the page in headless Chromium" page e2e
}

run_all_tests() {
  (install_tools "$native_tools" "$wasm_tools" "$node_tools" "$test_tools") || failed=1
  check format "Check the format of C++" check_format
  check layers "Check the layers" check_layers
  test_native
  test_wasm_build
  test_page
  say "Took $((SECONDS / 60)) min $((SECONDS % 60)) s."
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
}

tidy_everything() {
  install_tools "$native_tools" "$test_tools"
  phase release-configure "Configure, Release" cmake --preset release &&
    phase tidy "Tidy everything" tidy cpp_files
}
