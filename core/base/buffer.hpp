// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "mtstereo/image.hpp"

namespace mtstereo {

/// Alignment of buffers and of the rows of an Image, and the number of readable bytes after the
/// last element [bytes]: the widest vector of the supported processors.
inline constexpr std::size_t kAlignment = 64;

/// Aligned memory of a multiple of kAlignment [bytes]. Throws std::bad_alloc.
inline void* allocate_aligned(std::size_t bytes) {
  void* const memory = std::aligned_alloc(kAlignment, bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

/// Releases aligned memory, or leaves it to its owner.
struct Free {
  bool owned = true;
  void operator()(void* memory) const {
    if (owned) std::free(memory);
  }
};

/// Memory that groups of buffers use one after the other: a group loses its contents when the next
/// one is written. It only grows. Throws std::bad_alloc.
class ReusedMemory {
 public:
  /// Begins the next group, which takes the memory of the one before.
  void start_group() { used_ = 0; }
  /// Memory for a buffer of the group, a multiple of kAlignment [bytes]. If it had to grow, all
  /// buffers have to take theirs again; it does not grow then.
  void* take(std::size_t bytes) {
    const std::size_t end = used_ + bytes;
    if (end > capacity_) {
      memory_.reset();
      capacity_ = 0;
      memory_.reset(static_cast<std::byte*>(allocate_aligned(end)));
      capacity_ = end;
    }
    return memory_.get() + std::exchange(used_, end);
  }

 private:
  std::unique_ptr<std::byte[], Free> memory_;
  std::size_t used_ = 0;
  std::size_t capacity_ = 0;
};

/// An array of trivially copyable values. It owns its memory, which only grows: resize() allocates
/// nothing up to the largest size so far. Or it has a place in reused memory, which must outlive
/// it. The contents are not initialized. Throws std::bad_alloc.
template <typename T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void resize(std::size_t count, ReusedMemory* reused = nullptr) {
    if (reused != nullptr || count > capacity_) {
      data_.reset();
      capacity_ = size_ = 0;
      if (count > (std::numeric_limits<std::size_t>::max() - 4 * kAlignment) / sizeof(T)) {
        throw std::bad_alloc();
      }
      const std::size_t bytes = (count * sizeof(T) + 2 * kAlignment) / kAlignment * kAlignment;
      void* const memory = reused != nullptr ? reused->take(bytes) : allocate_aligned(bytes);
      data_ = {static_cast<T*>(memory), Free{reused == nullptr}};
      if (reused == nullptr) capacity_ = count;
    }
    size_ = count;
  }
  std::size_t size() const { return size_; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;  ///< of own memory
};

/// An image in a Buffer. Rows are aligned, and one whole vector after the end of each row can be
/// read and written (it belongs to the padding of the row).
template <typename T>
class Image {
 public:
  void resize(int width, int height, ReusedMemory* reused = nullptr) {
    const std::size_t row = (width * sizeof(T) + 2 * kAlignment - 1) / kAlignment * kAlignment;
    width_ = height_ = 0;  // the size if the next line throws
    buffer_.resize(row / sizeof(T) * height, reused);
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
