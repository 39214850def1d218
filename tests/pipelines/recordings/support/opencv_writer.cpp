// SPDX-License-Identifier: LGPL-2.1-or-later
// Writes gray frames as videos by OpenCV: opencv-writer WIDTH HEIGHT FRAMES [FOURCC VIDEO]...
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

namespace {

bool write(cv::Size size, const char* raw, const char* code, const char* video) {
  cv::VideoWriter writer(video, cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]), 30,
                         size);
  if (!writer.isOpened()) {
    std::fprintf(stderr, "OpenCV cannot write %s\n", video);
    return false;
  }
  cv::Mat frame(size, CV_8UC1), color;
  std::ifstream frames(raw, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(frame.total());
  while (frames.read(reinterpret_cast<char*>(frame.data), bytes)) {
    cv::merge(std::vector<cv::Mat>(3, frame), color);
    writer.write(color);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  const cv::Size size(std::atoi(argv[1]), std::atoi(argv[2]));
  for (int i = 4; i + 1 < argc; i += 2) {
    if (!write(size, argv[3], argv[i], argv[i + 1])) return 1;
  }
  return 0;
}
