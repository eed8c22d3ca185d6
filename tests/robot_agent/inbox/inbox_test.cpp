#include "robot_agent/inbox/inbox.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <utility>
#include <vector>

#include "shared/image/image_codec.hpp"

namespace cosight::inbox {
namespace {

constexpr Stamp ms(std::int64_t milliseconds) {
  return from_milliseconds(milliseconds);
}
constexpr PeerId kWearer{1};
constexpr PeerId kOtherWearer{2};

CameraModel camera_of(int width, int height) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  return camera;
}

ImageSample mono_frame(Stamp stamp, std::uint8_t value = 7) {
  ImageSample frame;
  frame.stamp = stamp;
  frame.encoding = ImageEncoding::kMono8;
  frame.width = 8;
  frame.height = 4;
  frame.bytes.assign(32, value);
  return frame;
}

ImageSample jpeg_frame(Stamp stamp, int width = 8, int height = 4) {
  ImageSample frame;
  frame.stamp = stamp;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  encode_jpeg(GrayImage{width, height, std::vector<std::uint8_t>(pixels, 128)}, 95, frame.bytes);
  return frame;
}

WearerPoseSample pose(Stamp stamp) {
  WearerPoseSample sample;
  sample.stamp = stamp;
  sample.T_SF.T.p = {0.5, 0.0, 0.0};
  return sample;
}

AhrsSample ahrs(Stamp stamp) {
  AhrsSample sample;
  sample.stamp = stamp;
  return sample;
}

/// A robot and its wearer on time set by hand: `run` pushes frames at 30 Hz and takes every bundle that is
/// ready.
class TwoAgentInbox : public testing::Test {
 protected:
  static InboxOptions options() {
    InboxOptions options;
    options.robot_size = {8, 4};
    options.camera_F = camera_of(8, 4);
    return options;
  }

  void wearer_sends(const PeerId& peer, Stamp stamp) {
    inbox_.push_ahrs(ahrs(stamp), peer);
    inbox_.push_wearer_frame(mono_frame(stamp), peer);
  }
  void step() {
    now_ += ms(33);
    stamp_ += ms(33);
    inbox_.push_wearer_pose(pose(stamp_));
    inbox_.push_robot_frame(mono_frame(stamp_));
  }
  void take_all() {
    while (auto bundle = inbox_.pop(0))
      bundles_.push_back(std::move(*bundle));
  }
  /// With the wearer `peer` sending; null: nobody.
  void run(int frames, const PeerId* peer) {
    for (int i = 0; i < frames; ++i) {
      step();
      if (peer != nullptr) wearer_sends(*peer, stamp_);
      take_all();
    }
  }
  int paired_since(std::size_t first) const {
    int paired = 0;
    for (std::size_t i = first; i < bundles_.size(); ++i)
      paired += bundles_[i].wearer ? 1 : 0;
    return paired;
  }
  void expect_complete(std::size_t frames) {
    now_ += ms(200);
    take_all();
    ASSERT_EQ(bundles_.size(), frames);
    for (std::size_t i = 1; i < bundles_.size(); ++i) {
      EXPECT_EQ(bundles_[i].stamp - bundles_[i - 1].stamp, ms(33));
    }
  }

  Stamp now_ = ms(1'000'000);
  Stamp stamp_ = ms(5'000);
  Inbox inbox_{options(), [this] { return now_; }};
  std::vector<FrameBundle> bundles_;
};

TEST_F(TwoAgentInbox, EveryFrameOfTwoLivingAgentsIsPaired) {
  run(30, &kWearer);
  expect_complete(30);
  EXPECT_EQ(paired_since(0), 30);
  const WearerView& view = *bundles_[3].wearer;
  EXPECT_EQ(view.stamp, bundles_[3].stamp);
  EXPECT_EQ(view.T_SF.T.p.x(), 0.5);
  EXPECT_EQ(view.image->width, 8);
  ASSERT_TRUE(view.q_WF);
  EXPECT_TRUE((*view.q_WF * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
}

TEST_F(TwoAgentInbox, PeerNeverComes) {
  run(60, nullptr);
  expect_complete(60);
  EXPECT_EQ(paired_since(0), 0);
  EXPECT_EQ(inbox_.counters().no_pair, 60U);
}

TEST_F(TwoAgentInbox, PeerKilledAndRestarted) {
  run(30, &kWearer);
  run(30, nullptr);
  run(30, &kOtherWearer);
  expect_complete(90);
  EXPECT_EQ(paired_since(0), 60);
  EXPECT_EQ(paired_since(60), 30);
  EXPECT_EQ(inbox_.counters().wearer_restarts, 1U);
  EXPECT_EQ(inbox_.counters().second_wearer, 0U);
}

TEST_F(TwoAgentInbox, PeerThatLosesItsLivelinessIsReplacedAtOnce) {
  run(30, &kWearer);
  inbox_.wearer_gone(kWearer);
  run(30, &kOtherWearer);
  expect_complete(60);
  EXPECT_EQ(paired_since(0), 60);
  EXPECT_EQ(inbox_.counters().wearer_restarts, 1U);
}

TEST_F(TwoAgentInbox, SecondWearerWithTheSameIdIsRefused) {
  for (int i = 0; i < 30; ++i) {
    step();
    wearer_sends(kWearer, stamp_);
    inbox_.push_wearer_frame(mono_frame(stamp_ - ms(1), 200), kOtherWearer);
    take_all();
  }
  expect_complete(30);
  EXPECT_EQ(paired_since(0), 30);
  EXPECT_EQ(inbox_.counters().wearer_restarts, 0U);
  EXPECT_EQ(inbox_.counters().second_wearer, 30U);
  for (const FrameBundle& bundle : bundles_)
    EXPECT_EQ(bundle.wearer->image->data[0], 7);
}

TEST_F(TwoAgentInbox, StampsThatGoBackAreRefusedAndTheRestGoesOn) {
  run(10, &kWearer);
  inbox_.push_robot_frame(mono_frame(stamp_ - ms(100)));
  inbox_.push_wearer_frame(mono_frame(stamp_ - ms(100)), kWearer);
  run(10, &kWearer);
  expect_complete(20);
  EXPECT_EQ(paired_since(0), 20);
  EXPECT_EQ(inbox_.counters().robot_out_of_order, 1U);
  EXPECT_EQ(inbox_.counters().worn_out_of_order, 1U);
}

TEST_F(TwoAgentInbox, WearerOnAnotherClockPairsOnceTheOffsetIsKnown) {
  const Stamp offset = ms(7'000);
  inbox_.stamps().set_wearer_offset(offset);
  for (int i = 0; i < 10; ++i) {
    step();
    wearer_sends(kWearer, stamp_ - offset);
    take_all();
  }
  expect_complete(10);
  EXPECT_EQ(paired_since(0), 10);
  EXPECT_EQ(bundles_[0].wearer->stamp, bundles_[0].stamp);
}

TEST_F(TwoAgentInbox, SaysHowFarTheWearersFramesAreBehind) {
  EXPECT_FALSE(inbox_.worn_behind());
  for (int i = 0; i < 50; ++i) {
    step();
    now_ += ms(20);
    inbox_.push_wearer_frame(mono_frame(stamp_), kWearer);
    now_ -= ms(20);
  }
  ASSERT_TRUE(inbox_.worn_behind());
  EXPECT_NEAR(to_seconds(*inbox_.worn_behind()), 0.020, 1e-4);
}

TEST_F(TwoAgentInbox, FramesWithoutPixelsStillGiveABundle) {
  ImageSample truncated = jpeg_frame(ms(10'000));
  truncated.bytes.resize(truncated.bytes.size() - 20);
  ImageSample small = mono_frame(ms(10'100));
  small.bytes.resize(10);
  ImageSample empty;
  empty.stamp = ms(10'200);
  inbox_.push_robot_frame(truncated);
  inbox_.push_robot_frame(small);
  inbox_.push_robot_frame(empty);
  inbox_.push_robot_frame(jpeg_frame(ms(10'300), 16, 16));
  inbox_.push_robot_frame(jpeg_frame(ms(10'400)));
  now_ += ms(1'000);
  take_all();
  ASSERT_EQ(bundles_.size(), 5U);
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(bundles_[static_cast<std::size_t>(i)].image, nullptr) << i;
  ASSERT_NE(bundles_[4].image, nullptr);
  EXPECT_EQ(bundles_[4].image->width, 8);
  EXPECT_EQ(inbox_.counters().robot_undecodable, 3U);
  EXPECT_EQ(inbox_.counters().robot_wrong_size, 1U);
}

TEST_F(TwoAgentInbox, WornFramesWithoutPixelsLeaveTheRobotFrameAlone) {
  step();
  ImageSample truncated = jpeg_frame(stamp_);
  truncated.bytes.resize(truncated.bytes.size() / 2);
  inbox_.push_ahrs(ahrs(stamp_), kWearer);
  inbox_.push_wearer_frame(truncated, kWearer);
  step();
  inbox_.push_ahrs(ahrs(stamp_), kWearer);
  inbox_.push_wearer_frame(jpeg_frame(stamp_, 16, 16), kWearer);
  expect_complete(2);
  EXPECT_EQ(paired_since(0), 0);
  EXPECT_NE(bundles_[0].image, nullptr);
  EXPECT_EQ(inbox_.counters().worn_undecodable, 1U);
  EXPECT_EQ(inbox_.counters().worn_wrong_size, 1U);
}

TEST_F(TwoAgentInbox, ItsCalibrationSaysHowLargeWornFramesAre) {
  inbox_.set_wearer_camera(camera_of(16, 16));
  step();
  inbox_.push_ahrs(ahrs(stamp_), kWearer);
  inbox_.push_wearer_frame(jpeg_frame(stamp_, 16, 16), kWearer);
  expect_complete(1);
  ASSERT_EQ(paired_since(0), 1);
  EXPECT_EQ(bundles_[0].wearer->camera.width, 16);
}

TEST_F(TwoAgentInbox, WithoutACalibrationNoWornFrameIsUsed) {
  Inbox inbox({}, [this] { return now_; });
  inbox.push_robot_frame(mono_frame(ms(100)));
  inbox.push_wearer_pose(pose(ms(100)));
  inbox.push_ahrs(ahrs(ms(100)), kWearer);
  inbox.push_wearer_frame(mono_frame(ms(100)), kWearer);
  const auto bundle = inbox.pop(0);
  ASSERT_TRUE(bundle);
  EXPECT_FALSE(bundle->wearer);
  EXPECT_NE(bundle->image, nullptr);
  EXPECT_EQ(inbox.counters().no_calibration, 1U);
}

TEST_F(TwoAgentInbox, ASlowEstimatorLosesImagesButNoRow) {
  for (int i = 0; i < 100; ++i) {
    step();
    wearer_sends(kWearer, stamp_);
  }
  expect_complete(100);
  EXPECT_EQ(inbox_.counters().robot_images_dropped, 40U);
  EXPECT_EQ(bundles_[39].image, nullptr);
  EXPECT_NE(bundles_[40].image, nullptr);
  EXPECT_EQ(paired_since(40), 60);
}

TEST_F(TwoAgentInbox, ClosingStillHandsOutWhatIsQueued) {
  step();
  inbox_.close();
  EXPECT_FALSE(inbox_.finished());
  expect_complete(1);
  EXPECT_TRUE(inbox_.finished());
  EXPECT_FALSE(inbox_.pop(ms(1'000)));
}

TEST(InboxThreads, EveryFrameComesThroughInOrderWhileOthersPush) {
  constexpr int kFrames = 500;
  InboxOptions options;
  options.pairing.max_queued_images = kFrames;
  Inbox inbox(options);
  std::thread robot([&inbox] {
    for (int i = 0; i < kFrames; ++i) {
      inbox.wait_for_room(ms(10'000));
      inbox.push_robot_frame(mono_frame(ms(33 * (i + 1))));
    }
    inbox.close();
  });
  std::thread wearer([&inbox] {
    for (int i = 0; i < kFrames; ++i) {
      inbox.push_ahrs(ahrs(ms(33 * (i + 1))), kWearer);
      inbox.push_wearer_pose(pose(ms(33 * (i + 1))));
      inbox.push_wearer_frame(mono_frame(ms(33 * (i + 1))), kWearer);
    }
  });
  Stamp last = 0;
  int bundles = 0;
  while (!inbox.finished()) {
    if (const auto bundle = inbox.pop(ms(100))) {
      EXPECT_GT(bundle->stamp, last);
      EXPECT_NE(bundle->image, nullptr);
      last = bundle->stamp;
      ++bundles;
    }
  }
  robot.join();
  wearer.join();
  EXPECT_EQ(bundles, kFrames);
  EXPECT_EQ(inbox.counters().robot_frames, static_cast<std::uint64_t>(kFrames));
}

TEST(PeerIdentity, IsThePrefixThatAllWritersOfAProcessShare) {
  std::array<std::uint8_t, 16> frames_writer{};
  for (std::size_t i = 0; i < 16; ++i)
    frames_writer.at(i) = static_cast<std::uint8_t>(i);
  std::array<std::uint8_t, 16> ahrs_writer = frames_writer;
  ahrs_writer[15] = 99;
  EXPECT_EQ(peer_of(frames_writer), peer_of(ahrs_writer));
  ahrs_writer[11] = 99;
  EXPECT_NE(peer_of(frames_writer), peer_of(ahrs_writer));
}

}  // namespace
}  // namespace cosight::inbox
