#include "memory/huge_page_pool.h"

#include <bdpt/memory/huge_pages.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace bdpt {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21U;

std::size_t rounded_up(std::size_t bytes, std::size_t unit)
{
    return (bytes + unit - 1) / unit * unit;
}

}  // namespace

void HugePagePool::Release::operator()(std::byte* slab) const noexcept
{
    ::operator delete (slab, std::align_val_t{huge_page});
}

void* HugePagePool::allocate(std::size_t bytes)
{
    const std::size_t size = rounded_up(bytes, cache_line);
    const std::lock_guard lock(mutex_);
    if (Freed*& first = free_[size]; first != nullptr) {
        return std::exchange(first, first->next);
    }
    if (size > left_) {
        // Pages that no block uses take no memory.
        constexpr std::size_t usual_pages = 4;
        const std::size_t slab_bytes =
            rounded_up(std::max(size, usual_pages * huge_page), huge_page);
        Slab slab(
            static_cast<std::byte*>(::operator new (slab_bytes, std::align_val_t{huge_page})));
        prefer_huge_pages(slab.get(), slab_bytes);
        next_ = slab.get();
        left_ = slab_bytes;
        slabs_.push_back(std::move(slab));
    }
    left_ -= size;
    return std::exchange(next_, next_ + size);
}

void HugePagePool::free(void* block, std::size_t bytes) noexcept
{
    const std::lock_guard lock(mutex_);
    Freed*& first = free_.find(rounded_up(bytes, cache_line))->second;
    first = new (block) Freed{.next = first};
}

#if defined(__linux__) && defined(MADV_HUGEPAGE)
void prefer_huge_pages(void* begin, std::size_t bytes) noexcept
{
    constexpr std::size_t huge_page = std::size_t{1} << 21U;
    if (bytes < huge_page) {
        return;
    }
    // The kernel accepts whole pages, and creates large ones where they fit.
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto address = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = (address + page - 1) / page * page;
    const std::uintptr_t end = (address + bytes) / page * page;
    // If it fails, pages are unchanged.
    static_cast<void>(
        madvise(static_cast<char*>(begin) + (first - address), end - first, MADV_HUGEPAGE));
}
#else
void prefer_huge_pages(void* /*begin*/, std::size_t /*bytes*/) noexcept {}
#endif

}  // namespace bdpt
