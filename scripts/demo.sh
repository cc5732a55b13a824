# shellcheck shell=bash
# ./pleat demo. Sourced by ./pleat after phase.sh, install.sh and build.sh.

is_port_free() { ! (exec 4<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

free_port() {
  local port=$1
  until is_port_free "$port"; do port=$((port + 1)); done
  echo "$port"
}

# Waits until the server answers, then shows the page where there is a desktop.
announce() {
  local server=$1 port=$2 address=http://127.0.0.1:$2/
  while is_port_free "$port"; do
    kill -0 "$server" 2>/dev/null || return 1
    sleep 0.1
  done
  say "Pleat is at $address (Ctrl-C stops it)"
  if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && command -v xdg-open >/dev/null; then
    xdg-open "$address" >/dev/null 2>&1 &
  fi
}

serve() {
  local port=$1 server
  cd "$root/web" || return 1
  node node_modules/vite/bin/vite.js preview --host 127.0.0.1 --port "$port" --strictPort \
    >"$root/build/logs/serve.log" 2>&1 </dev/null &
  server=$!
  trap 'kill "$server" 2>/dev/null' EXIT
  trap 'exit 0' INT TERM
  announce "$server" "$port" || give_up "The server did not start: see build/logs/serve.log."
  wait "$server"
}

run_demo() {
  local port=''
  if [ "${1:-}" = --port ]; then
    port=${2:-}
    if ! [[ $port =~ ^[1-9][0-9]{0,4}$ ]] || [ "$port" -gt 65535 ]; then
      bad_usage "--port: expected a number from 1 to 65535, got '$port'."
    fi
    is_port_free "$port" || give_up "Port $port is taken."
    shift 2
  fi
  [ $# -eq 0 ] || bad_usage "demo: expected nothing or --port NUMBER, got '$1'."

  install_tools "$wasm_tools" "$node_tools"
  install_suitesparse || say "Going on without SuiteSparse: the page's direct solver is Eigen's."
  phase wasm-build "Build WebAssembly" build_wasm || return 1
  use_node && install_page_packages || return 1
  phase page-build "Build the page" page build || return 1
  serve "${port:-$(free_port 4173)}"
}
