// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// A made-up camera (tests/support/fake_camera.h) stands behind the system calls. Checked:
// which mode is asked for and what is read back, every frame and every one that is missing,
// the camera's clock, the controls and their order, each failure with a message that says what
// to do, and that nothing stays open or mapped, whatever happens.
#include "src/capture/camera_stream.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "src/capture/camera_list.h"
#include "src/capture/fourcc.h"
#include "src/input_error.h"
#include "tests/support/fake_camera.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::AsYuyv;
using testing::FakeBuffer;
using testing::FakeCamera;
using testing::GreyRamp;

class CameraStreamTest : public ::testing::Test {
 protected:
  CameraStreamTest() {
    MakeWebcam(&camera_);
    camera_.frame = [this](int) { return FakeBuffer{picture_}; };
  }
  // Whatever a test did to it.
  ~CameraStreamTest() override {
    EXPECT_EQ(camera_.num_open(), 0);
    EXPECT_EQ(camera_.num_mapped(), 0);
    EXPECT_EQ(camera_.num_streaming(), 0);
  }

  CameraMode Given(const CameraMode& wanted) {
    CameraOptions options;
    options.wanted = wanted;
    return CameraStream(camera_.path, options, &camera_).given();
  }

  // What comes of opening it and of reading some frames.
  std::string Complaint(const CameraOptions& options = {}) {
    try {
      CameraStream stream(camera_.path, options, &camera_);
      for (int i = 0; i < 100; ++i) stream.Read(0.1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(no complaint)";
  }

  void ExpectComplaint(const std::string& mention, const CameraOptions& options = {}) {
    const std::string complaint = Complaint(options);
    EXPECT_EQ(complaint.rfind("/dev/video0: ", 0), 0u) << complaint;
    EXPECT_NE(complaint.find(mention), std::string::npos) << complaint;
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  }

  FakeCamera camera_;
  std::string picture_ = AsYuyv(GreyRamp({640, 480}));
};

TEST_F(CameraStreamTest, ListsWhatIsOffered) {
  const V4l2Device device(camera_.path, &camera_);
  const auto formats = ListFormats(device);
  ASSERT_EQ(formats.size(), 3u);
  EXPECT_EQ(formats[0].fourcc, kFourccYuyv);
  EXPECT_EQ(formats[1].description, "Motion-JPEG");
  ASSERT_EQ(formats[0].sizes.size(), 2u);
  EXPECT_EQ(formats[0].sizes[0].size_px, cv::Size(1280, 720));
  EXPECT_EQ(formats[0].sizes[0].rates_hz, (std::vector<double>{10.0, 5.0}));
}

TEST_F(CameraStreamTest, ListsTheUsualSizesOfARange) {
  camera_.formats = {{kFourccYuyv, "any", {}, true, {48, 32}, {1280, 720}}};
  const V4l2Device device(camera_.path, &camera_);
  const auto formats = ListFormats(device, {500, 300});
  ASSERT_EQ(formats.size(), 1u);
  EXPECT_TRUE(formats[0].any_size);
  std::vector<int> widths_px;
  for (const CameraSize& size : formats[0].sizes) {
    widths_px.push_back(size.size_px.width);
    EXPECT_DOUBLE_EQ(size.rates_hz.front(), 60.0);
    EXPECT_DOUBLE_EQ(size.rates_hz.back(), 2.0);
  }
  EXPECT_EQ(widths_px, (std::vector<int>{1280, 960, 800, 640, 640, 500, 320, 48}));
}

TEST_F(CameraStreamTest, TakesMjpgWhereYuyvIsSlow) {
  EXPECT_EQ(Given({0, {1280, 720}, 30.0}), (CameraMode{kFourccMjpg, {1280, 720}, 30.0}));
  EXPECT_EQ(Given({0, {1280, 720}, 10.0}), (CameraMode{kFourccYuyv, {1280, 720}, 10.0}));
  EXPECT_EQ(Given({0, {640, 480}, 30.0}), (CameraMode{kFourccYuyv, {640, 480}, 30.0}));
  EXPECT_EQ(Given({0, {640, 480}, 60.0}), (CameraMode{kFourccMjpg, {640, 480}, 60.0}));
  EXPECT_EQ(Given({kFourccYuyv, {1280, 720}, 10.0}), (CameraMode{kFourccYuyv, {1280, 720}, 10.0}));
}

TEST(ChooseMode, TakesTheNearestSizeThenTheHighestRate) {
  FakeCamera camera;
  MakeWebcam(&camera);
  EXPECT_EQ(ChooseMode(camera.formats, {0, {1920, 1080}, 60.0}),
            (CameraMode{kFourccMjpg, {1280, 720}, 30.0}));
  EXPECT_EQ(ChooseMode(camera.formats, {kFourccYuyv, {1280, 720}, 30.0}),
            (CameraMode{kFourccYuyv, {1280, 720}, 10.0}));
  // The lowest that is enough.
  EXPECT_EQ(ChooseMode(camera.formats, {kFourccMjpg, {640, 480}, 20.0}).rate_hz, 30.0);
  EXPECT_EQ(ChooseMode({}, {0, {1280, 720}, 30.0}).fourcc, 0u);
}

TEST_F(CameraStreamTest, KeepsWhatWasAskedAndWhatWasGiven) {
  camera_.give = [](CameraMode asked) {
    return CameraMode{kFourccYuyv, {640, 480}, std::min(asked.rate_hz, 15.0)};
  };
  camera_.bytes_per_line = 1344;
  const CameraStream stream(camera_.path, {}, &camera_);
  EXPECT_EQ(stream.asked(), (CameraMode{kFourccMjpg, {1280, 720}, 30.0}));
  EXPECT_EQ(stream.given(), (CameraMode{kFourccYuyv, {640, 480}, 15.0}));
  EXPECT_EQ(stream.format().bytes_per_line, 1344);
  EXPECT_EQ(ModeText(stream.asked()), "1280x720 MJPG 30 Hz");
}

// Of a loopback device the writer fixes the format.
TEST_F(CameraStreamTest, SaysTheSizeThatWasWantedWhereItIsNotOffered) {
  const CameraStream stream(camera_.path, {.wanted = {kFourccYuyv, {1000, 700}, 10.0}}, &camera_);
  EXPECT_EQ(stream.asked(), (CameraMode{kFourccYuyv, {1000, 700}, 10.0}));
  EXPECT_EQ(stream.given(), (CameraMode{kFourccYuyv, {1280, 720}, 10.0}));
}

TEST_F(CameraStreamTest, TakesTheFormatThatAWriterHasFixed) {
  camera_.errors[VIDIOC_S_FMT] = EBUSY;
  CameraStream stream(camera_.path, {}, &camera_);
  EXPECT_EQ(stream.given().fourcc, kFourccYuyv);
  EXPECT_EQ(stream.given().size_px, cv::Size(640, 480));
  EXPECT_TRUE(stream.Read(1.0));
}

TEST_F(CameraStreamTest, DoesWithoutListsAndRates) {
  camera_.errors = {{VIDIOC_ENUM_FMT, ENOTTY}, {VIDIOC_G_PARM, ENOTTY}};
  CameraStream stream(camera_.path, {}, &camera_);
  EXPECT_EQ(stream.given().rate_hz, 0.0);
  EXPECT_TRUE(stream.Read(1.0));
}

TEST_F(CameraStreamTest, GivesTheBytesInOrder) {
  camera_.frame = [&](int i) { return FakeBuffer{std::string(1000, static_cast<char>(i))}; };
  CameraStream stream(camera_.path, {}, &camera_);
  for (int i = 0; i < 20; ++i) {
    const auto frame = stream.Read(1.0);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->bytes.total(), 1000u);
    EXPECT_EQ(frame->bytes.at<uchar>(0, 999), i);
    EXPECT_EQ(frame->sequence, static_cast<uint32_t>(i));
    EXPECT_EQ(frame->num_lost, 0);
  }
  EXPECT_EQ(stream.counts().given, 20);
  EXPECT_EQ(stream.counts().num_missing(), 0);
}

TEST_F(CameraStreamTest, CountsGapsAndBrokenBuffers) {
  camera_.frame = [&](int i) {
    FakeBuffer buffer{picture_, static_cast<uint32_t>(100 + i)};
    if (i >= 3) buffer.sequence += 2;  // two are lost before frame 3
    if (i == 5) buffer.flags = V4L2_BUF_FLAG_ERROR;
    if (i == 6) buffer.bytes.clear();
    if (i == 8) buffer.sequence = 7;  // starts anew: says nothing
    if (i > 8) buffer.sequence = static_cast<uint32_t>(i - 1);
    return buffer;
  };
  CameraStream stream(camera_.path, {}, &camera_);
  std::vector<int> lost;
  for (int i = 0; i < 10; ++i) lost.push_back(stream.Read(1.0).value().num_lost);
  EXPECT_EQ(lost, (std::vector<int>{0, 0, 0, 2, 0, 2, 0, 0, 0, 0}));
  EXPECT_EQ(stream.counts().lost, 2);
  EXPECT_EQ(stream.counts().bad, 2);
}

TEST_F(CameraStreamTest, CountsAcrossTheEndOfTheNumbers) {
  camera_.frame = [&](int i) {
    return FakeBuffer{picture_, 0xfffffffeU + 2U * static_cast<uint32_t>(i)};
  };
  CameraStream stream(camera_.path, {}, &camera_);
  stream.Read(1.0);
  stream.Read(1.0);  // number 0, which the fake takes for its own count: 1
  EXPECT_EQ(stream.counts().lost, 2);
}

TEST_F(CameraStreamTest, TakesTheDriversClock) {
  camera_.frame = [&](int i) { return FakeBuffer{picture_, 0, 0, 1000.0 + (i + 1) / 30.0 - 0.01}; };
  CameraStream stream(camera_.path, {}, &camera_);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(stream.Read(1.0).value().monotonic_s, 1000.0 + (i + 1) / 30.0 - 0.01, 2e-6);
}

// Of another clock, in the future, long past, standing still: the time of arrival.
TEST_F(CameraStreamTest, DistrustsAClockThatCannotBe) {
  const std::vector<FakeBuffer> odd = {{picture_, 0, 0, 1000.1, false},
                                       {picture_, 0, 0, 5e8},
                                       {picture_, 0, 0, 3.0},
                                       {picture_, 0, 0, 1000.02},
                                       {picture_, 0, 0, 1000.02}};
  camera_.frame = [&](int i) { return odd[static_cast<size_t>(i)]; };
  CameraStream stream(camera_.path, {}, &camera_);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(stream.Read(1.0).value().monotonic_s, 1000.0 + (i + 1) / 30.0, 1e-9) << i;
}

TEST_F(CameraStreamTest, WaitsNoLongerThanAsked) {
  camera_.num_frames = 2;
  CameraStream stream(camera_.path, {}, &camera_);
  EXPECT_TRUE(stream.Read(1.0));
  EXPECT_TRUE(stream.Read(1.0));
  const double before_s = camera_.Now_s();
  EXPECT_FALSE(stream.Read(2.5));
  EXPECT_NEAR(camera_.Now_s() - before_s, 2.5, 0.01);
}

TEST_F(CameraStreamTest, SurvivesAPassingError) {
  camera_.errors_at_frame = {{2, EIO}, {3, EIO}};
  CameraStream stream(camera_.path, {}, &camera_);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(stream.Read(1.0)) << i;
}

TEST_F(CameraStreamTest, SaysWhatToDo) {
  camera_.open_error = EACCES;
  ExpectComplaint("usermod -aG video");
  camera_.open_error = EBUSY;
  ExpectComplaint("used by another program");
  camera_.open_error = ENODEV;
  ExpectComplaint("plug it in again");
  camera_.open_error = EMFILE;
  ExpectComplaint("cannot open it: Too many open files");
  camera_.open_error = ENOENT;
  ExpectComplaint("no such device; plug the camera in");
}

TEST_F(CameraStreamTest, SaysWhichCallFails) {
  for (const auto& [request, error, mention] :
       {std::tuple(VIDIOC_QUERYCAP, ENOTTY, "is no video device"),
        {VIDIOC_G_FMT, EINVAL, "has no format yet"},
        {VIDIOC_G_FMT, ENOMEM, "cannot ask for its format"},
        {VIDIOC_S_FMT, ENODEV, "is gone"},
        {VIDIOC_REQBUFS, EBUSY, "used by another program"},
        {VIDIOC_REQBUFS, ENOMEM, "cannot share memory"},
        {VIDIOC_QUERYBUF, EINVAL, "cannot share memory"},
        {0UL, ENOMEM, "cannot share memory"},  // mmap
        {VIDIOC_QBUF, EINVAL, "cannot start streaming"},
        {VIDIOC_STREAMON, ENOSPC, "take MJPG, a smaller size or a lower rate"},
        {VIDIOC_STREAMON, EIO, "reports an error"},
        {VIDIOC_DQBUF, ENODEV, "is gone: unplugged"},
        {VIDIOC_DQBUF, EIO, "reports an error"},
        {VIDIOC_DQBUF, EPIPE, "reports an error"}}) {
    camera_.errors = {{request, error}};
    ExpectComplaint(mention);
  }
}

TEST_F(CameraStreamTest, RefusesWhatIsNoCamera) {
  camera_.device_caps = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  ExpectComplaint("gives no pictures (Fake Camera");
  camera_.device_caps = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_READWRITE;
  ExpectComplaint("cannot stream");
}

TEST_F(CameraStreamTest, RefusesAFormatThatCannotBeDecoded) {
  camera_.give = [](CameraMode) { return CameraMode{Fourcc('H', '2', '6', '4'), {640, 480}, 30}; };
  ExpectComplaint("gives H264 pictures, wanted MJPG, YUYV, NV12 or GREY");
  CameraOptions options;
  options.wanted.fourcc = Fourcc('H', '2', '6', '4');
  ExpectComplaint("format = H264, wanted MJPG", options);
}

TEST_F(CameraStreamTest, GivesAllFramesBeforeItIsUnplugged) {
  camera_.num_frames = 7;
  camera_.unplugged_at_end = true;
  CameraStream stream(camera_.path, {}, &camera_);
  for (int i = 0; i < 7; ++i) EXPECT_TRUE(stream.Read(1.0));
  EXPECT_THROW(stream.Read(1.0), InputError);
}

// Between two calls: the picture that was taken is given before the error.
TEST_F(CameraStreamTest, GivesAFrameWhoseBufferIsNotTakenBack) {
  CameraStream stream(camera_.path, {}, &camera_);
  camera_.errors[VIDIOC_QBUF] = ENODEV;
  EXPECT_TRUE(stream.Read(1.0));
}

TEST_F(CameraStreamTest, ListsControls) {
  const V4l2Device device(camera_.path, &camera_);
  const auto controls = ListControls(device);
  ASSERT_EQ(controls.size(), camera_.controls.size());
  EXPECT_EQ(controls[4].name, "auto_exposure");
  EXPECT_EQ(controls[4].menu.at(1), "Manual Mode");
  EXPECT_EQ(controls[4].menu.size(), 2u);
  EXPECT_EQ(controls[5].name, "exposure_time_absolute");
  EXPECT_EQ(controls[5].highest, 2047);
  EXPECT_EQ(controls[5].value, 333);
}

TEST_F(CameraStreamTest, SetsAutomaticsToManualBeforeTheirValue) {
  CameraOptions options;
  for (const char* text : {"exposure=50", "white_balance=4000", "focus_absolute=30", "gain=43"})
    options.controls.push_back(ParseControl(text));
  const CameraStream stream(camera_.path, options, &camera_);
  EXPECT_EQ(camera_.set_controls(),
            (std::vector<std::string>{"auto_exposure", "exposure_time_absolute",
                                      "white_balance_automatic", "white_balance_temperature",
                                      "focus_automatic_continuous", "focus_absolute", "gain"}));
  EXPECT_EQ(camera_.control("auto_exposure").value, V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(camera_.control("white_balance_automatic").value, 0);
  EXPECT_EQ(camera_.control("exposure_time_absolute").value, 50);
  ASSERT_EQ(stream.controls().size(), 4u);
  EXPECT_EQ(stream.controls()[3].asked, 43);
  EXPECT_EQ(stream.controls()[3].given, 40);  // in steps of 5
}

TEST_F(CameraStreamTest, SetsMenusByTheirWords) {
  const V4l2Device device(camera_.path, &camera_);
  EXPECT_EQ(SetControl(device, {"auto_exposure", "Manual Mode"}).given, 1);
  EXPECT_EQ(SetControl(device, {"auto_exposure", "aperture_priority_mode"}).given, 3);
}

TEST_F(CameraStreamTest, RefusesControlsThatItDoesNotHave) {
  const auto complaint = [&](const std::string& text) {
    CameraOptions options;
    options.controls = {ParseControl(text)};
    return Complaint(options);
  };
  EXPECT_NE(complaint("gian=3").find("such as gain"), std::string::npos) << complaint("gian=3");
  EXPECT_NE(complaint("exposure=9000").find("wanted 3 to 2047"), std::string::npos);
  EXPECT_NE(complaint("gain=bright").find("0 to 100 in steps of 5"), std::string::npos);
  EXPECT_NE(complaint("auto_exposure=2").find("1 (Manual Mode), 3 (Aperture"), std::string::npos);
  camera_.errors[VIDIOC_S_CTRL] = EINVAL;
  EXPECT_NE(complaint("gain=10").find("refuses gain = 10"), std::string::npos);
  for (const char* text : {"", "gain", "gain=", "=3"})
    EXPECT_THROW(ParseControl(text), InputError) << text;
}

TEST(ListCameras, GivesStableNames) {
  namespace fs = std::filesystem;
  const fs::path dev = testing::ScratchDir();
  for (const char* node : {"video0", "video2", "video10", "video", "vid1", "video1x"})
    std::ofstream(dev / node).put(' ');
  fs::create_directories(dev / "v4l" / "by-id");
  fs::create_directories(dev / "v4l" / "by-path");
  fs::create_symlink("../../video2", dev / "v4l" / "by-id" / "usb-Fake_Camera-video-index0");
  fs::create_symlink("../../video2", dev / "v4l" / "by-path" / "pci-0000:00:14.0-usb-0:1");
  FakeCamera camera;
  MakeWebcam(&camera);
  camera.path = dev / "video2";
  const auto cameras = ListCameras(&camera, dev);
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_EQ(cameras[0].path, dev / "video0");
  EXPECT_NE(cameras[0].problem.find("no such device"), std::string::npos);
  EXPECT_EQ(cameras[1].name, "Fake Camera");
  EXPECT_EQ(cameras[1].problem, "");
  EXPECT_EQ(cameras[1].formats.size(), 3u);
  EXPECT_EQ(cameras[1].stable_paths,
            (std::vector<std::string>{dev / "v4l/by-id/usb-Fake_Camera-video-index0",
                                      dev / "v4l/by-path/pci-0000:00:14.0-usb-0:1"}));
  EXPECT_EQ(cameras[2].path, dev / "video10");
  camera.device_caps = V4L2_CAP_META_CAPTURE;
  EXPECT_EQ(ListCameras(&camera, dev).size(), 2u);
  EXPECT_EQ(camera.num_open(), 0);
  EXPECT_TRUE(ListCameras(&camera, dev / "absent").empty());
}

}  // namespace
}  // namespace poselift
