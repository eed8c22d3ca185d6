# shellcheck shell=bash
# What every script needs: where things are, how to build them, how to complain.

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

# say TEXT…: a line about what happens now, on stderr, so that stdout holds results only.
say() { echo "== $*" >&2; }

die() {
  echo "$(basename "$0"): $*" >&2
  exit 1
}

# find_data [DIR]: the folder of the real data; nothing printed and false when there is none.
find_data() {
  local candidate
  for candidate in "${1:-}" "${COSIGHT_DATA:-}" "$source_dir/../shared/data"; do
    if [[ -n $candidate && -d $candidate ]]; then
      (cd "$candidate" && pwd)
      return 0
    fi
  done
  return 1
}

# build_programs PRESET TARGET…: configures and builds; the output is shown only when something fails.
build_programs() {
  local preset=$1 log
  shift
  log=$source_dir/build/$preset.log
  mkdir -p "$source_dir/build"
  say "building $* ($preset)"
  if ! { (cd "$source_dir" && cmake --preset "$preset" && cmake --build --preset "$preset" --target "$@") >"$log" 2>&1; }; then
    tail -n 60 "$log" >&2
    die "the build failed; the whole output is in $log"
  fi
}
