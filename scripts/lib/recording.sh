# shellcheck shell=bash
# Records a run of the agents, and gives the recording to a robot again: by topics, or as a file. After common.sh and
# agents.sh; set `programs`, and trap `stop_recorder || true; stop_agents`.

recorder=''

# start_recorder FILE [OPTION…]: returns when it records; its process id in `recorder`. `run_domain` as for run_agents.
start_recorder() {
  local file=$1 waited
  shift
  rm -f "$file"
  "$programs/cosight" record "$file" --domain "${run_domain:-$(private_domain)}" "$@" >"$file.log" 2>&1 &
  recorder=$!
  for ((waited = 0; waited < 200; ++waited)); do
    [[ ! -s $file ]] || return 0
    sleep 0.1
  done
  die "the recorder does not start; see $file.log"
}

# stop_recorder: as Ctrl-C does. 3 says that messages were lost; the log says how many.
stop_recorder() {
  local status=0
  [[ -n $recorder ]] || return 0
  kill -TERM "$recorder" 2>/dev/null || true
  wait_for "$recorder" 10 || status=$?
  recorder=''
  ((status == 0 || status == 3)) || { say "the recorder ended with status $status"; return 1; }
}

# run_replayed FILE DATASET RUN_DIR MODE [ROBOT_OPTION…]: a robot that hears the recording on its topics; DATASET says how
# it is built. What the recorded robot said itself is left out. The replay's report ends in RUN_DIR/replay.log.
run_replayed() {
  local file=$1 dataset=$2 run_dir=$3 mode=$4 robot status=0
  local domain=${run_domain:-$(private_domain)}
  shift 4
  rm -rf "$run_dir"
  mkdir -p "$run_dir"
  "$programs/robot_agent" --config "$source_dir/config/robot.yaml" --from-topics --dataset "$dataset" --mode "$mode" \
    --run-dir "$run_dir" --domain "$domain" --wait-for-wearer 20 "$@" >"$run_dir.robot.log" 2>&1 &
  robot=$!
  agent_pids+=("$robot")
  "$programs/cosight" replay "$file" --domain "$domain" --patience 20 \
    --wait-for '/cosight/robot/image*' '/cosight/wearable/image*' '/cosight/wearable/imu' \
    --exclude '/cosight/robot/odometry' '/cosight/robot/map' '/cosight/robot/overlap' '/cosight/robot/diagnostics' '/cosight/robot/heartbeat' \
    >"$run_dir.replay.log" 2>&1 || die "the replay failed; see $run_dir.replay.log"
  wait_for "$robot" 30 || status=$?
  stop_agents
  collect_logs "$run_dir"
  mv "$run_dir.replay.log" "$run_dir/replay.log"
  ((status == 0 || status == 3)) || die "the robot ended with status $status; see $run_dir/robot.log"
}

# run_offline FILE DATASET RUN_DIR MODE RATE [ROBOT_OPTION…]: without DDS; RATE 0 for as fast as possible.
run_offline() {
  local file=$1 dataset=$2 run_dir=$3 mode=$4 rate=$5 status=0
  shift 5
  rm -rf "$run_dir"
  "$programs/robot_agent" --config "$source_dir/config/robot.yaml" --from "$file" --rate "$rate" --dataset "$dataset" \
    --mode "$mode" --run-dir "$run_dir" "$@" >"$run_dir.robot.log" 2>&1 || status=$?
  ((status == 0 || status == 3)) || die "the run out of $file ended with status $status; see $run_dir.robot.log"
  mv "$run_dir.robot.log" "$run_dir/robot.log"
}

# same_results RUN_DIR RUN_DIR: whether the results of two runs are the same, byte for byte.
same_results() {
  local file
  for file in trajectory.tum frames.csv map.ply map.pcd; do
    cmp -s "$1/$file" "$2/$file" || return 1
  done
}
