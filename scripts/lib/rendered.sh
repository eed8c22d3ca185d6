# shellcheck shell=bash
# What the rendered experiments share: sequences of the simulator through both agents, in each mode, several at a time.
# After common.sh, agents.sh and experiment.sh.

modes=(collaborative mono)

# rendered_arguments ARG…: sets out, build, runs, seed, jobs, rate and keep.
rendered_arguments() {
  out='' build=yes runs='' seed=1 jobs=$(nproc) replay_rate=1 keep=no
  while (($# > 0)); do
    case $1 in
      --out) out=${2:?--out needs a folder}; shift 2 ;;
      --runs) runs=${2:?--runs needs a number}; shift 2 ;;
      --seed) seed=${2:?--seed needs a number}; shift 2 ;;
      --jobs) jobs=${2:?--jobs needs a number}; shift 2 ;;
      --rate) replay_rate=${2:?--rate needs a number}; shift 2 ;;
      --keep-images) keep=yes; shift ;;
      --skip-build) build=no; shift ;;
      -h | --help) experiment_usage; rendered_usage; exit 0 ;;
      *) experiment_usage >&2; rendered_usage >&2; echo "$(basename "$0"): unknown option $1" >&2; exit 2 ;;
    esac
  done
  [[ -n $out ]] || { experiment_usage >&2; exit 2; }
  mkdir -p "$out"
  out=$(cd "$out" && pwd)
  [[ $build == no ]] || build_programs release robot_agent wearable_agent cosight sim
  programs=${COSIGHT_PROGRAMS:-$source_dir/build/release/bin}
}

rendered_usage() {
  cat <<'TEXT'

  --runs N        fewer sequences
  --seed N        of the first one (1)
  --jobs N        sequences at a time (as many as cores)
  --rate N        times real time (1)
  --keep-images   leave the rendered pictures in the run folders
  --skip-build    use the programs as they are
TEXT
}

# sequence NAME SCENE SEED [SIM_OPTION…]: renders it and runs it in each mode; NAME/MODE gets the results. The robot starts
# at the first look that both cameras share (no surveyed points), and finds the wearer with its lasers and their AHRS.
sequence() {
  local name=$1 scene=$2 number=$3 mode
  shift 3
  trap stop_agents EXIT
  agent_pids=()
  local folder=$out/$name
  rm -rf "$folder"
  mkdir -p "$folder"
  "$programs/sim" --config "$source_dir/config/scenes/$scene.yaml" --out "$folder/dataset" --seed "$number" --threads 1 \
    --set known_points=0 "$@" >"$folder/sim.log" 2>&1 || { tail -n 5 "$folder/sim.log" >&2; return 1; }
  for mode in "${modes[@]}"; do
    run_agents "$folder/dataset" "$folder/$mode" "$mode" --wearer-pose laser || return 1
    evaluate_run "$folder/dataset" "$folder/$mode" first_pose "$name $mode" || return 1
  done
  [[ $keep == yes ]] || rm -rf "$folder"/dataset/{robot,wearer}/cam0
  for mode in "${modes[@]}"; do
    say "$name, $mode: $(sed -n 's/^ *final_error_m *//p' "$folder/$mode/evaluation.txt") m"
  done
}

# in_parallel: reads lines "NAME SCENE SEED [SIM_OPTION…]", runs each as a sequence of its own; sets names.
in_parallel() {
  local line failed=0
  names=()
  while read -ra line; do
    names+=("${line[0]}")
    while (($(jobs -rp | wc -l) >= jobs)); do wait -n || failed=1; done
    run_domain=$((100 + ($$ + ${#names[@]}) % 120)) sequence "${line[@]}" </dev/null &
  done
  while (($(jobs -rp | wc -l) > 0)); do wait -n || failed=1; done
  ((failed == 0)) || die "a sequence failed; see the logs in $out"
}

# tabulate: table, runs.csv and summary.json over all names.
tabulate() { "$programs/cosight" aggregate "$out" "${names[@]}" --modes "$(IFS=,; echo "${modes[*]}")" | tee "$out/table.txt"; }

# draw NAME: the plot of that name, which is told the runs' names.
draw() {
  cp "$source_dir/scripts/experiments/plots/$1.gp" "$out/"
  (cd "$out" && gnuplot -e "runs='${names[*]}'" "$1.gp") || die "gnuplot made no picture; is gnuplot-nox installed?"
}
