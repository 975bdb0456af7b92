#pragma once

#include <bdpt/export.h>

#include <cstddef>
#include <vector>

namespace bdpt {

/// Asks for large pages for memory that is about to be written and then read here and there: with
/// pages of 4 KB a third of such reads waits for the place of a page before the memory itself. Does
/// nothing where the system has no such pages, and never changes what is stored.
BDPT_EXPORT void prefer_huge_pages(void* begin, std::size_t bytes) noexcept;

/// Reserves room for `size` values; where that is new memory, it has large pages if it can.
template <typename T>
inline void reserve_in_huge_pages(std::vector<T>& values, std::size_t size)
{
    if (values.capacity() < size) {
        values.reserve(size);
        prefer_huge_pages(static_cast<void*>(values.data() + values.size()),
                          (size - values.size()) * sizeof(T));
    }
}

/// Resizes the vector in such memory.
template <typename T>
inline void resize_in_huge_pages(std::vector<T>& values, std::size_t size)
{
    reserve_in_huge_pages(values, size);
    values.resize(size);
}

}  // namespace bdpt
