#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>

#include "shared/config/calibration.hpp"
#include "shared/dataset/number_text.hpp"
#include "shared/evaluation/association.hpp"
#include "shared/evaluation/csv_table.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "shared/image/image_codec.hpp"
#include "tools/prepare/image_list.hpp"
#include "tools/prepare/lens_change.hpp"
#include "tools/prepare/prepare_error.hpp"
#include "tools/prepare/real_sequence.hpp"
#include "tools/prepare/view_assignment.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;

constexpr Stamp kMaxDifference = 1'000'000;  // [ns]; the poses' stamps are rounded to some 100 ns

/// A picture of the room taken at another time.
struct View {
  fs::path file;
  Stamp taken = 0;
  Pose T_WF;
  std::string camera;
};

/// Adds the true poses to images; all of them must have one.
std::vector<RecordedImage> with_poses(std::vector<RecordedImage> images, const fs::path& truth_file) {
  Trajectory stamps;
  for (const RecordedImage& image : images)
    stamps.push_back({image.stamp, {}});
  const std::vector<PosePair> pairs = associate(stamps, read_trajectory(truth_file), kMaxDifference);
  if (pairs.size() != images.size()) {
    throw PrepareError(truth_file.string() + ": has a pose for only " + std::to_string(pairs.size()) +
                       " of " + std::to_string(images.size()) + " images");
  }
  for (std::size_t i = 0; i < images.size(); ++i)
    images[i].T_WC = pairs[i].T_WC_truth;
  return images;
}

std::vector<RecordedImage> read_flight(const fs::path& flight) {
  const CsvTable table = CsvTable::read(flight / "cam0.csv");
  std::vector<RecordedImage> images;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    images.push_back(
        {table.stamp(row, "t_ns"), fs::canonical(flight / "cam0" / table.text(row, "file")), {}});
  }
  return with_poses(std::move(images), flight / "gt_cam0.tum");
}

/// The views of one camera; their file names are their stamps.
std::vector<View> read_views(const fs::path& folder, const std::string& camera) {
  std::vector<RecordedImage> images;
  for (const fs::path& file : images_in(folder / camera)) {
    const auto stamp = parse_nanoseconds(file.stem().string());
    if (!stamp) throw PrepareError(file.string() + ": the name is not a time in nanoseconds");
    images.push_back({*stamp, file, {}});
  }
  std::vector<View> views;
  for (const RecordedImage& image : with_poses(std::move(images), folder / ("gt_" + camera + ".tum"))) {
    views.push_back({image.file, image.stamp, *image.T_WC, camera});
  }
  return views;
}

/// A view that the flying camera took is that very frame: it shows nothing from another place.
bool is_a_flight_frame(const View& view, const std::vector<RecordedImage>& flight) {
  return view.camera == "cam0" && std::any_of(flight.begin(), flight.end(), [&](const RecordedImage& image) {
           return std::abs(image.stamp - view.taken) < kMaxDifference;
         });
}

std::string note_of(const OfferedView& offer, const View& view, const RecordedImage& frame, Stamp start) {
  std::ostringstream note;
  note << std::fixed << "frame " << std::setw(3) << offer.frame << "  t " << std::setprecision(2)
       << to_seconds(frame.stamp - start) << " s  " << view.camera << " view at " << std::setw(6)
       << to_seconds(view.taken - start) << " s  baseline " << offer.baseline << " m  between axes "
       << std::setprecision(1) << std::setw(5) << offer.axis_angle * 180.0 / std::numbers::pi << " deg";
  return note.str();
}

template <typename Item, typename PoseOf>
std::vector<Pose> poses_of(const std::vector<Item>& items, PoseOf pose_of) {
  std::vector<Pose> poses;
  poses.reserve(items.size());
  for (const Item& item : items)
    poses.push_back(pose_of(item));
  return poses;
}

/// Brings views of all cameras to one lens.
class LensUnifier {
 public:
  LensUnifier(const fs::path& calibration, const CameraModel& lens, fs::path folder)
      : other_(load_camera_model(calibration, "cam1")), lens_(lens), folder_(std::move(folder)) {
    fs::create_directories(folder_);
  }

  fs::path file_of(const View& view) const {
    if (view.camera == "cam0") return view.file;
    const fs::path file = folder_ / (view.camera + "_" + view.file.stem().string() + ".png");
    write_image(file, with_other_lens(read_image(view.file), other_, lens_));
    return fs::canonical(file);
  }

 private:
  CameraModel other_;
  CameraModel lens_;
  fs::path folder_;
};

std::vector<View> usable_views(const fs::path& folder, const std::vector<RecordedImage>& flight) {
  std::vector<View> views = read_views(folder, "cam0");
  const std::vector<View> second = read_views(folder, "cam1");
  views.insert(views.end(), second.begin(), second.end());
  std::erase_if(views, [&](const View& view) { return is_a_flight_frame(view, flight); });
  return views;
}

}  // namespace

RealSequence read_euroc(const fs::path& flight, const fs::path& views_folder,
                        const fs::path& rendered_images) {
  RealSequence sequence;
  sequence.robot_camera = load_camera_model(flight / "calib.yaml", "cam0");
  sequence.wearer_camera = load_camera_model(views_folder / "calib.yaml", "cam0");
  sequence.robot_images = read_flight(flight);
  const std::vector<View> views = usable_views(views_folder, sequence.robot_images);
  const LensUnifier lens(views_folder / "calib.yaml", sequence.wearer_camera, rendered_images);
  const auto offers =
      assign_views(poses_of(views, [](const View& view) { return view.T_WF; }),
                   poses_of(sequence.robot_images, [](const auto& image) { return *image.T_WC; }));
  const Stamp start = sequence.robot_images.front().stamp;
  for (const OfferedView& offer : offers) {
    const View& view = views[offer.view];
    const RecordedImage& frame = sequence.robot_images[offer.frame];
    sequence.wearer_images.push_back({frame.stamp, lens.file_of(view), view.T_WF});
    sequence.notes.push_back(note_of(offer, view, frame, start));
  }
  return sequence;
}

}  // namespace cosight
