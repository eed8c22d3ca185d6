# shellcheck shell=bash
# What the two urban canyons share.
# shellcheck source=common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
# shellcheck source=experiment.sh
source "$(dirname "${BASH_SOURCE[0]}")/experiment.sh"

# urban_canyon NUMBER TRACKS ARG…: the whole experiment; TRACKS: folder below urban_tracks of the data.
urban_canyon() {
  local number=$1 tracks=$2 data
  shift 2
  parse_arguments "$@"
  if data=$(find_data) && [[ -d $data/urban_tracks/$tracks ]]; then
    more+=(--tracks "$data/urban_tracks/$tracks")
  else
    say "no urban_tracks: set COSIGHT_DATA to run over them too"
  fi
  # How well the window knows its own error has to be shown once only.
  [[ $number != 1 ]] || more+=(--consistency 50)
  run_experiment experiment_urban_canyon --canyon "$number" "${more[@]}"
  plot urban_canyon
}
