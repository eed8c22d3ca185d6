# shellcheck shell=bash
# The visual-inertial odometry of a run. Needs common.sh; set `programs` to the folder of the programs.

# evaluate_vins RUN_DIR TRUTH OUT_DIR NAME: errors.csv, evaluation.json and trajectory.png of RUN_DIR/vins.tum into OUT_DIR.
# Its world is its own, so it is laid onto the truth. False when VINS never started; the reasons are said.
evaluate_vins() {
  local run_dir=$1 truth=$2 out_dir=$3 name=$4
  if [[ $(grep -vc '^#' "$run_dir/vins.tum") -lt 3 ]]; then
    say "vins gave no trajectory; frames by what was missing:"
    sed -n '/^vins_not_yet_observable:/,/^[^ ]/{/^  .*: [1-9]/p}' "$run_dir/summary.yaml" >&2
    return 1
  fi
  mkdir -p "$out_dir"
  "$programs/cosight" evaluate "$run_dir/vins.tum" "$truth" --align se3 --out "$out_dir" --plot --name "$name" \
    >"$out_dir/evaluation.txt"
  [[ $run_dir -ef $out_dir ]] || cp "$run_dir/summary.yaml" "$out_dir/"
}

# run_vins_flight DATA OUT: the real flight from camera and IMU alone, the sensors' noise as its calibration tells it.
run_vins_flight() {
  local flight=$1/euroc_v101_flight out=$2 status=0
  rm -rf "$out/vins"
  "$programs/robot_agent" --config "$source_dir/config/robot.yaml" --only vins --images "$flight/cam0.csv" \
    --calibration "$flight/calib.yaml" --set input.imu="$flight/imu.csv" --rate 0 --domain "$(private_domain)" \
    --set vins.pixel_sigma=0.3 --set vins.accelerometer_noise=2.0e-3 --set vins.gyroscope_noise=1.6968e-4 \
    --set vins.accelerometer_walk=3.0e-3 --set vins.gyroscope_walk=1.9393e-5 --run-dir "$out/vins" \
    >"$out/vins.log" 2>&1 || status=$?
  ((status == 0)) || { tail -n 20 "$out/vins.log" >&2; die "the robot ended with status $status; see $out/vins.log"; }
  evaluate_vins "$out/vins" "$flight/gt_cam0.tum" "$out/vins" vins || die "vins never started"
  sed -n '/^vins:/,/^[^ ]/{s/^  first_start_s: /first start [s]: /p}' "$out/vins/summary.yaml" >&2
  "$programs/cosight" summarise "$out" vins --metrics ate_m,ate_rotation_deg,rpe_m,final_error_m,scale_error_percent,frames,path_m
}

# split_pieces RUN_DIR: RUN_DIR/piece_N.tum, one for each start: after each W is another.
split_pieces() {
  rm -f "$1"/piece_*
  awk -v name="$1/piece_" '/^# started anew/ { ++k } !/^#/ { print > (name k + 1 ".tum") }' "$1/vins.tum"
}

# longest_piece RUN_DIR: the file with the most poses of those that belong together; false when there is none.
longest_piece() {
  split_pieces "$1"
  wc -l "$1"/piece_*.tum 2>/dev/null | awk '$2 != "total" && $1 > most { most = $1; file = $2 } END { if (!file) exit 1; print file }'
}
