// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include "mtstereo/image.hpp"

namespace mtstereo {

/// Alignment of buffers and of the rows of an Image, and the number of readable bytes after the
/// last element [bytes]: the widest vector of the supported processors.
inline constexpr std::size_t kAlignment = 64;

/// Owner of an array of trivially copyable values. The memory only grows: resize() allocates
/// nothing up to the largest size so far. The contents are not initialized. Throws std::bad_alloc.
template <typename T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void resize(std::size_t count) {
    if (count > capacity_) {
      data_.reset();
      capacity_ = size_ = 0;
      if (count > (std::numeric_limits<std::size_t>::max() - 4 * kAlignment) / sizeof(T)) {
        throw std::bad_alloc();
      }
      const std::size_t bytes = (count * sizeof(T) + 2 * kAlignment) / kAlignment * kAlignment;
      data_.reset(static_cast<T*>(std::aligned_alloc(kAlignment, bytes)));
      if (data_ == nullptr) throw std::bad_alloc();
      capacity_ = count;
    }
    size_ = count;
  }
  std::size_t size() const { return size_; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    void operator()(T* data) const { std::free(data); }
  };
  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// Owner of an image. Rows are aligned, and one whole vector after the end of each row can be read
/// and written (it belongs to the padding of the row).
template <typename T>
class Image {
 public:
  void resize(int width, int height) {
    const std::size_t row = (width * sizeof(T) + 2 * kAlignment - 1) / kAlignment * kAlignment;
    width_ = height_ = 0;  // the size if the next line throws
    buffer_.resize(row / sizeof(T) * height);
    width_ = width;
    height_ = height;
    stride_ = row / sizeof(T);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }  ///< from row to row [elements]
  T* row(int y) { return buffer_.data() + y * stride_; }
  const T* row(int y) const { return buffer_.data() + y * stride_; }
  ImageView<const T> view() const {
    return {buffer_.data(), width_, height_, static_cast<std::ptrdiff_t>(stride_ * sizeof(T))};
  }

 private:
  Buffer<T> buffer_;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

}  // namespace mtstereo
