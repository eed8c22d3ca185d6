# shellcheck shell=bash
# Runs the two agents as two processes over DDS. Needs common.sh; set `programs` to the folder of the programs.

agent_pids=()

# Whatever ends a script ends its agents too: only those that it started, by their process ids. TERM, because a shell
# without a terminal starts its children deaf to INT; KILL for one that has not gone after five seconds.
stop_agents() {
  local pid
  for pid in "${agent_pids[@]}"; do
    kill -TERM "$pid" 2>/dev/null || true
  done
  for pid in "${agent_pids[@]}"; do
    wait_for "$pid" 5 || kill -KILL "$pid" 2>/dev/null || true
  done
  agent_pids=()
}

# A DDS domain that other runs on this machine hardly share. 100 to 219; above 232 the ports run out.
private_domain() { echo $((100 + $$ % 120)); }

# wait_for PID SECONDS: the exit status of a child, or 124 when it takes longer.
wait_for() {
  local pid=$1 limit=$2 began=$SECONDS
  while kill -0 "$pid" 2>/dev/null; do
    ((SECONDS - began < limit)) || return 124
    sleep 0.2
  done
  wait "$pid"
}

# wait_for_line PID FILE PATTERN: until a line of FILE matches, 20 s at most, or PID has ended.
wait_for_line() {
  local began=$SECONDS
  while ! grep -qs -- "$3" "$2" && kill -0 "$1" 2>/dev/null && ((SECONDS - began < 20)); do sleep 0.05; done
}

# run_agents DATASET RUN_DIR MODE [ROBOT_OPTION…]: one run; the robot's results and both logs end in RUN_DIR. A dataset
# without a wearer runs the robot alone. Variables, each empty for the usual: `gate`, the times at which the wearer looks;
# `replay_rate`, times real time; `run_domain`, the DDS domain.
run_agents() {
  local dataset=$1 run_dir=$2 mode=$3 domain robot wearer='' status=0 patience=()
  shift 3
  domain=${run_domain:-$(private_domain)}
  rm -rf "$run_dir"
  mkdir -p "$run_dir"
  [[ ! -d $dataset/wearer ]] || patience=(--wait-for-wearer 20)
  "$programs/robot_agent" --config "$source_dir/config/robot.yaml" --dataset "$dataset" --mode "$mode" \
    --run-dir "$run_dir" --domain "$domain" "${patience[@]}" ${replay_rate:+--rate "$replay_rate"} "$@" >"$run_dir.robot.log" 2>&1 &
  robot=$!
  agent_pids+=("$robot")
  if [[ -d $dataset/wearer ]]; then
    # The robot first: a recorder listens too, and the wearable would take it for the robot that it waits for.
    wait_for_line "$robot" "$run_dir.robot.log" "robot '.*' on domain"
    "$programs/wearable_agent" --config "$source_dir/config/wearable.yaml" --dataset "$dataset" --domain "$domain" \
      --wait-for-robot 20 --summary "$run_dir.wearable.yaml" ${gate:+--gate "$gate"} ${replay_rate:+--rate "$replay_rate"} >"$run_dir.wearable.log" 2>&1 &
    wearer=$!
    agent_pids+=("$wearer")
  fi
  wait_for "$robot" "${run_limit_s:-300}" || status=$?
  # A robot that ended well has seen the wearer's last frame; one that failed needs no wearer any more.
  if [[ -n $wearer ]] && ((status == 0 || status == 3)); then
    wait_for "$wearer" 20 || say "the wearable ended with status $?; see $run_dir/wearable.log"
  fi
  stop_agents
  collect_logs "$run_dir"
  # 3 says that samples were lost; the run is still a run, and its summary counts them.
  if ((status != 0 && status != 3)); then
    tail -n 20 "$run_dir/robot.log" >&2
    die "the robot ended with status $status; see $run_dir/robot.log"
  fi
}

# The agents' logs lie beside the run folder while it is made, because the robot refuses one that is not empty.
collect_logs() {
  local run_dir=$1
  mv "$run_dir.robot.log" "$run_dir/robot.log"
  [[ ! -f $run_dir.wearable.log ]] || mv "$run_dir.wearable.log" "$run_dir/wearable.log"
  [[ ! -f $run_dir.wearable.yaml ]] || mv "$run_dir.wearable.yaml" "$run_dir/wearable_summary.yaml"
}

# evaluate_run DATASET RUN_DIR ALIGNMENT NAME: errors.csv, evaluation.json and trajectory.png into RUN_DIR.
evaluate_run() {
  local dataset=$1 run_dir=$2 alignment=$3 name=$4
  "$programs/cosight" evaluate "$run_dir/trajectory.tum" "$dataset/truth/robot_cam0.tum" --align "$alignment" \
    --frames "$run_dir/frames.csv" --out "$run_dir" --plot --name "$name" >"$run_dir/evaluation.txt"
}
