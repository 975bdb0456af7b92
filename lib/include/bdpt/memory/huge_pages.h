#pragma once

/// @file
/// Puts large vectors into large pages of memory.
///
/// @code{.cpp}
/// std::vector<bdpt::Rgb> pixels;
/// bdpt::resize_in_huge_pages(pixels, std::size_t{16384} * 16384);
/// @endcode

#include <bdpt/export.h>

#include <cstddef>
#include <vector>

namespace bdpt {

/// Requests large pages for memory that is about to be written and then read at random: with pages
/// of 4 KB, a third of such reads waits for address translation before the memory itself. Does
/// nothing on systems without such pages, and never changes the contents.
BDPT_EXPORT void prefer_huge_pages(void* begin, std::size_t bytes) noexcept;

/// Reserves room for `size` values, in large pages if new memory is allocated.
template <typename T>
inline void reserve_in_huge_pages(std::vector<T>& values, std::size_t size)
{
    if (values.capacity() < size) {
        values.reserve(size);
        prefer_huge_pages(static_cast<void*>(values.data() + values.size()),
                          (size - values.size()) * sizeof(T));
    }
}

/// Resizes the vector, in large pages if new memory is allocated.
template <typename T>
inline void resize_in_huge_pages(std::vector<T>& values, std::size_t size)
{
    reserve_in_huge_pages(values, size);
    values.resize(size);
}

}  // namespace bdpt
