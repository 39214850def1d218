// SPDX-License-Identifier: LGPL-2.1-or-later
// Writes gray frames as a video by OpenCV: opencv-writer FOURCC WIDTH HEIGHT FRAMES VIDEO.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  const char* const code = argv[1];
  cv::Mat frame(std::atoi(argv[3]), std::atoi(argv[2]), CV_8UC1), color;
  cv::VideoWriter writer(argv[5], cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]), 30,
                         frame.size());
  if (!writer.isOpened()) {
    std::fprintf(stderr, "OpenCV cannot write %s\n", argv[5]);
    return 1;
  }
  std::ifstream frames(argv[4], std::ios::binary);
  const auto size = static_cast<std::streamsize>(frame.total());
  while (frames.read(reinterpret_cast<char*>(frame.data), size)) {
    cv::merge(std::vector<cv::Mat>(3, frame), color);
    writer.write(color);
  }
  return 0;
}
