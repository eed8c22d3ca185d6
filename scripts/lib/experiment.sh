# shellcheck shell=bash
# What the experiments at feature level share: their arguments, their program, their plots. After common.sh.

# parse_arguments ARG…: sets out, build and more, the options that the program itself gets.
parse_arguments() {
  out='' build=yes more=()
  while (($# > 0)); do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --skip-build) build=no; shift ;;
      --runs | --seed) more+=("$1" "${2:?$1 needs a number}"); shift 2 ;;
      -h | --help) experiment_usage; exit 0 ;;
      *) experiment_usage >&2; echo "$(basename "$0"): unknown option $1" >&2; exit 2 ;;
    esac
  done
  [[ -n $out ]] || { experiment_usage >&2; exit 2; }
  mkdir -p "$out"
  out=$(cd "$out" && pwd)
}

# experiment_usage: the comment at the head of the script.
experiment_usage() { sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0"; }

# run_experiment PROGRAM ARG…: builds it unless told not to, and runs it; its table is the script's.
run_experiment() {
  local program=$1
  shift
  [[ $build == no ]] || build_programs release "$program"
  "${COSIGHT_PROGRAMS:-$source_dir/build/release/bin}/$program" --out "$out" "$@" | tee "$out/table.txt"
}

# plot NAME: draws with scripts/experiments/plots/NAME.gp, which stays beside the pictures so that they can be drawn again.
plot() {
  cp "$source_dir/scripts/experiments/plots/$1.gp" "$out/"
  (cd "$out" && gnuplot "$1.gp") || die "gnuplot made no picture; is the package gnuplot-nox installed?"
}
