#include <gmock/gmock.h>

#include <opencv2/videoio.hpp>

#include "shared/dataset/image_list_source.hpp"
#include "shared/dataset/v4l2_source.hpp"
#include "shared/dataset/video_source.hpp"
#include "tests/shared/dataset/dataset_fixture.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class ImageSource : public DatasetFixture {
 protected:
  /// Five frames 100 ms apart and their csv.
  std::filesystem::path five_frames(const std::string& extension = ".jpg") const {
    std::string csv = "stamp_ns,file\n";
    for (int i = 0; i < 5; ++i) {
      const std::string name = "cam0/" + std::to_string(i) + extension;
      write_frame(name, 40 * i);
      csv += std::to_string(1'000'000'000 + 100'000'000 * i) + "," + name + "\n";
    }
    return write("cam0.csv", csv);
  }

  std::filesystem::path frame(int i) const { return folder_ / "cam0" / (std::to_string(i) + ".jpg"); }
};

TEST_F(ImageSource, PlaysACsvWithItsStamps) {
  ImageListSource source(read_image_csv(five_frames()), {});
  const auto samples = all_of(source);
  EXPECT_THAT(stamps_of(samples),
              ElementsAre(1'000'000'000, 1'100'000'000, 1'200'000'000, 1'300'000'000, 1'400'000'000));
  EXPECT_THAT(sequences_of(samples), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(source.counters().delivered, 5U);
  EXPECT_EQ(source.counters().lost(), 0U);
  EXPECT_EQ(source.counters().gaps, 0U);
  EXPECT_EQ(source.counters(SampleKind::kAhrs).delivered, 0U);
}

TEST_F(ImageSource, AJpegPassesUnchangedUnlessAQualityIsForced) {
  const auto csv = five_frames();
  std::vector<std::uint8_t> on_disk;
  ASSERT_TRUE(read_bytes(frame(0), on_disk));
  const auto first = [&](const FrameOutput& output) {
    ImageListSource source(read_image_csv(csv), output);
    return std::get<ImageSample>(*source.next());
  };
  const ImageSample unchanged = first({});
  EXPECT_EQ(unchanged.bytes, on_disk);
  EXPECT_EQ(unchanged.width, 32);
  EXPECT_EQ(unchanged.height, 24);
  FrameOutput forced;
  forced.quality = 20;
  EXPECT_NE(first(forced).bytes, on_disk);
}

TEST_F(ImageSource, FramesComeInTheEncodingThatIsWanted) {
  for (const char* const extension : {".jpg", ".png"}) {
    for (const ImageEncoding encoding : {ImageEncoding::kJpeg, ImageEncoding::kPng, ImageEncoding::kMono8}) {
      FrameOutput output;
      output.encoding = encoding;
      ImageListSource source(read_image_csv(five_frames(extension)), output);
      source.next();
      const auto sample = std::get<ImageSample>(*source.next());
      ASSERT_EQ(sample.encoding, encoding);
      GrayImage image{sample.width, sample.height, sample.bytes};
      if (encoding != ImageEncoding::kMono8) {
        ASSERT_EQ(decode_gray(sample.bytes, {32, 24}, image), DecodeOutcome::kDecoded);
      }
      ASSERT_THAT(image.data, SizeIs(32 * 24));
      EXPECT_NEAR(image.data[100], 40, 2);
    }
  }
}

TEST_F(ImageSource, MissingTruncatedAndWronglySizedFramesAreCountedAndLeaveHolesInTheSequence) {
  const auto csv = five_frames();
  std::filesystem::remove(frame(1));
  cut_short(frame(2));
  write_frame("cam0/3.jpg", 0, 16, 16);
  FrameOutput output;
  output.width = 32;
  output.height = 24;
  ImageListSource source(read_image_csv(csv), output);
  EXPECT_THAT(sequences_of(all_of(source)), ElementsAre(0, 4));
  EXPECT_EQ(source.counters().delivered, 2U);
  EXPECT_EQ(source.counters().unreadable, 2U);
  EXPECT_EQ(source.counters().wrong_size, 1U);
  EXPECT_EQ(source.counters().lost(), 3U);
}

TEST_F(ImageSource, ATruncatedFrameIsFoundWhenItHasToBeReencodedToo) {
  const auto csv = five_frames();
  cut_short(frame(2));
  FrameOutput output;
  output.encoding = ImageEncoding::kMono8;
  ImageListSource source(read_image_csv(csv), output);
  EXPECT_THAT(sequences_of(all_of(source)), ElementsAre(0, 1, 3, 4));
  EXPECT_EQ(source.counters().unreadable, 1U);
}

TEST_F(ImageSource, BadStampsAndGapsAreCounted) {
  five_frames();
  const auto csv = write("bad.csv",
                         "stamp_ns,file\n1000,cam0/0.jpg\nnan,cam0/1.jpg\n2000,cam0/1.jpg\n1500,cam0/2.jpg\n"
                         "2000,cam0/2.jpg\n3000,cam0/2.jpg\nx\n4000,cam0/3.jpg\n7500,cam0/4.jpg\n");
  ImageListSource source(read_image_csv(csv), {});
  EXPECT_THAT(stamps_of(all_of(source)), ElementsAre(1000, 2000, 3000, 4000, 7500));
  EXPECT_EQ(source.counters().not_finite, 2U);
  EXPECT_EQ(source.counters().stamp_went_back, 2U);
  EXPECT_EQ(source.counters().gaps, 1U);
}

TEST_F(ImageSource, FindsEurocKittiAndCsvBesideTheFolder) {
  write_frame("euroc/mav0/cam0/data/5.png", 1);
  write("euroc/mav0/cam0/data.csv", "#timestamp [ns],filename\n5,5.png\n");
  write_frame("kitti/left/000000.png", 1);
  write_frame("kitti/left/000001.png", 2);
  write("kitti/times.txt", "0.000000e+00\n1.037359e-01\n");
  write_frame("flight/cam0/000000.jpg", 1);
  write("flight/cam0.csv", "#idx,t_ns,file\n0,77,000000.jpg\n");
  write_frame("tello/cam0/000000.jpg", 1);
  write("tello/cam0.csv", "#idx,t_s,file\n0,0.090002,000000.jpg\n");
  const auto stamps = [&](const char* path) {
    ImageListSource source(find_images(folder_ / path), {});
    return stamps_of(all_of(source));
  };
  EXPECT_THAT(stamps("euroc"), ElementsAre(5));
  EXPECT_THAT(stamps("euroc/mav0/cam0"), ElementsAre(5));
  EXPECT_THAT(stamps("kitti/left"), ElementsAre(0, 103735900));
  EXPECT_THAT(stamps("kitti/left/"), ElementsAre(0, 103735900));
  EXPECT_THAT(stamps("flight"), ElementsAre(77));
  EXPECT_THAT(stamps("flight/cam0"), ElementsAre(77));
  EXPECT_THAT(stamps("tello/cam0"), ElementsAre(90002000));
}

TEST_F(ImageSource, APlainFolderNeedsARate) {
  write_frame("b.png", 1);
  write_frame("a.png", 2);
  write("notes.txt", "not an image");
  EXPECT_THAT(error_of<DatasetError>([&] { find_images(folder_); }), HasSubstr("give input.rate_hz"));
  ImageListSource source(find_images(folder_, 10.0), {});
  EXPECT_THAT(stamps_of(all_of(source)), ElementsAre(0, 100'000'000));
}

TEST_F(ImageSource, AnInputThatCanNotBePlayedIsNamed) {
  const auto error = [](const std::filesystem::path& path) {
    return error_of<DatasetError>([&] { find_images(path); });
  };
  EXPECT_THAT(error(folder_ / "none"), HasSubstr("none: no such file or folder"));
  EXPECT_THAT(error(write("empty.csv", "")), HasSubstr("empty.csv: has no row"));
  EXPECT_THAT(error(write("header.csv", "\ntime,picture\n1,a.png\n")), HasSubstr("header.csv:2: no column"));
  EXPECT_THAT(error(write("gone.csv", "stamp_ns,file\n1,a.png\n")),
              HasSubstr("gone.csv:2: none of the first images"));
  write_frame("a.png", 1);
  EXPECT_THAT(error(write("nan.csv", "stamp_ns,file\nnan,a.png\n")), HasSubstr("nan.csv: has no usable row"));
  write_frame("k/a.png", 1);
  write("k/times.txt", "0\n1\n");
  EXPECT_THAT(error(folder_ / "k"), HasSubstr("has 2 times for the 1 images"));
}

TEST_F(ImageSource, AVideoGivesItsFramesAtItsRate) {
  const auto file = folder_ / "a.avi";
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         20.0, {64, 48});
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < 5; ++i)
    writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 * i)));
  writer.release();
  VideoSource of_container(file, 0.0, {});
  const auto samples = all_of(of_container);
  EXPECT_THAT(stamps_of(samples), ElementsAre(0, 50'000'000, 100'000'000, 150'000'000, 200'000'000));
  GrayImage image;
  ASSERT_EQ(decode_gray(std::get<ImageSample>(samples[3]).bytes, {64, 48}, image), DecodeOutcome::kDecoded);
  EXPECT_NEAR(image.data[1000], 120, 3);
  VideoSource of_rate(file, 10.0, {});
  EXPECT_EQ(stamps_of(all_of(of_rate)).back(), 400'000'000);
  FrameOutput larger;
  larger.width = 65;
  VideoSource wrong(file, 0.0, larger);
  EXPECT_TRUE(all_of(wrong).empty());
  EXPECT_EQ(wrong.counters().wrong_size, 5U);
}

TEST_F(ImageSource, AVideoThatIsNoneIsNamed) {
  EXPECT_THAT(error_of<DatasetError>([&] { VideoSource(folder_ / "no.mp4", 0.0, {}); }),
              HasSubstr("no such video file"));
  const auto text = write("text.mp4", "not a video");
  EXPECT_THAT(error_of<DatasetError>([&] { VideoSource(text, 0.0, {}); }), HasSubstr("is no video"));
}

TEST(V4l2, AMissingCameraOrADeviceThatIsNoneIsNamed) {
  const std::atomic<bool> stop = false;
  const auto error = [&](const char* device) {
    V4l2Options options;
    options.device = device;
    return error_of<DatasetError>([&] { V4l2Source(options, {}, stop); });
  };
  EXPECT_THAT(error("/dev/no_such_camera"), HasSubstr("/dev/no_such_camera: can't be opened (No such file"));
  EXPECT_THAT(error("/dev/null"), HasSubstr("/dev/null: is no V4L2 camera"));
}

TEST(V4l2, BrightnessOfYuyvIsEverySecondByteOfARow) {
  const std::vector<std::uint8_t> yuyv = {1, 99, 2, 99, 0, 0, 3, 99, 4, 99, 0, 0};  // rows padded by two
  GrayImage image;
  gray_of_yuyv(yuyv.data(), 2, 2, 6, image);
  EXPECT_THAT(image.data, ElementsAre(1, 2, 3, 4));
}

}  // namespace
}  // namespace cosight
