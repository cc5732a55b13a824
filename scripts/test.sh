# shellcheck shell=bash
# ./pleat test and ./pleat tidy. Sourced by ./pleat after phase.sh, install.sh and build.sh.

cpp_files() { git ls-files -- 'core/*.h' 'core/*.cpp' 'cli/*.h' 'cli/*.cpp' 'wasm/*.h' 'wasm/*.cpp' \
  'native-tests/*.h' 'native-tests/*.cpp'; }

check_format() { cpp_files | xargs -r clang-format --dry-run -Werror; }

check_layers() {
  python3 native-tests/check_layers.py --self-test && python3 native-tests/check_layers.py
}

check_comments() {
  python3 native-tests/check_comments.py --self-test && python3 native-tests/check_comments.py
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

# clang-tidy reads one file at a time, as a build without unity files and precompiled headers compiles it.
configure_tidy() {
  cmake --preset release -B build/tidy -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
}

# Sources the native build compiles; a changed header is checked through the source beside it.
tidy_sources() {
  sed -n 's/\.h$/.cpp/p; /\.cpp$/p' | sort -u | while read -r source; do
    if grep -qF "$root/$source\"" build/tidy/compile_commands.json; then echo "$source"; fi
  done
}

# tidy LIST: clang-tidy over the files the command LIST names, one process per core. The bindings are read as
# Emscripten's compiler, which is of the same version, reads them.
tidy() {
  local files sysroot=/usr/share/emscripten/cache/sysroot
  files=$("$1")
  tidy_sources <<<"$files" | tee /dev/stderr |
    xargs -r -n 1 -P "$(nproc)" clang-tidy -p build/tidy --quiet &&
    sed -n '/^wasm\/.*\.cpp$/p' <<<"$files" | tee /dev/stderr |
    xargs -r -P "$(nproc)" -I {} clang-tidy --quiet {} -- -std=c++20 --target=wasm32-unknown-emscripten --sysroot="$sysroot" \
      -isystem "$sysroot/include/compat" -isystem build/wasm/hosted -isystem /usr/include/eigen3 -D__EMSCRIPTEN__ \
      -fwasm-exceptions -msimd128 -I .
}

# The modules that have native tests, one a line.
tested_modules() { (cd "$root/native-tests" && printf '%s\n' */*_test.cpp) | cut -d / -f 1 | sort -u; }

# run_native_tests "MODULE…" PRESET [SELECTION]: their tests, or those that Catch2's SELECTION names; as many programs
# at a time as there are cores, the largest first.
run_native_tests() {
  local modules=$1 preset=$2 total module
  shift 2
  total=$(wc -w <<<"$modules")
  # shellcheck disable=SC2086,SC2016
  (cd "build/$preset/native-tests" && ls -S $(printf '%s_tests ' $modules)) |
    awk -v total="$total" '{ print NR "/" total, $1 }' |
    xargs -L 1 -P "$(nproc)" bash -c '
      program=$PWD/build/$0/native-tests/${*: -1}
      echo "[${*: -2:1}] ${*: -1}"
      "$program" --use-colour no "${@:1:$#-2}" >"$program.log" 2>&1
      status=$?
      cat "$program.log"
      exit "$status"' "$preset" "$@"
}

# The hard cases last as long as all other long motions together.
run_long_tests() {
  printf '%s\n' '[long][hard_cases]' '[long]~[hard_cases]' |
    xargs -P "$(nproc)" -I {} bash -c '
      log=$0.$$.log
      "$0" --use-colour no "$1" >"$log" 2>&1
      status=$?
      cat "$log" && rm "$log"
      exit "$status"' build/release/native-tests/long_tests {}
}

# Tests that join modules, and the eigensolver's templates, take a compiler with sanitizers as long as all the rest;
# long motions walk the same code as short ones, twenty times slower then.
release_modules="cli error hard_cases modal reference sweep"

test_in_release() {
  # shellcheck disable=SC2046,SC2086
  step release-build "Build, Release" build_preset release pleat long_tests $(printf '%s_tests ' $release_modules) &&
    suite read_catch2 long-tests "Test long motions, Release" run_long_tests &&
    suite read_catch2 release-tests "Test, Release" run_native_tests "$release_modules" release '~[long]'
}

test_with_sanitizers() {
  local modules
  modules=$(tested_modules | grep -vwE "${release_modules// /|}" | tr '\n' ' ')
  # shellcheck disable=SC2046
  step dev-build "Build with sanitizers" build_preset dev $(printf '%s_tests ' $modules) &&
    suite read_catch2 dev-tests "Test with sanitizers" run_native_tests "$modules" dev '~[long]'
  step tidy-configure "Configure for clang-tidy" configure_tidy &&
    check tidy "Tidy what changed" tidy changed_files
}

# One module alone, in Release.
test_module() {
  if [ $# -ne 1 ] || ! tested_modules | grep -qxF -- "$1"; then
    bad_usage "test: expected nothing or one of $(tested_modules | paste -sd ' '), got '$*'."
  fi
  install_tools "$native_tools" "$test_tools"
  step "$1-build" "Build the tests of $1" build_preset release "$1_tests" &&
    suite read_catch2 "$1-tests" "Test $1" run_native_tests "$1" release
  summary
}

summary() {
  echo "$passed passed, $failed failed"
  [ "$failed" -eq 0 ]
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
  check comments "Check the comments" check_comments
  test_in_release
  # The page's tests wait for a browser now and then, and leave a core to the compiler.
  meanwhile test_with_sanitizers
  test_wasm_build
  test_page
  say "Meanwhile:"
  rejoin
  say "Took $((SECONDS / 60)) min $((SECONDS % 60)) s."
  summary
}

tidy_everything() {
  install_tools "$native_tools" "$test_tools"
  phase tidy-configure "Configure for clang-tidy" configure_tidy &&
    phase tidy "Tidy everything" tidy cpp_files
}
