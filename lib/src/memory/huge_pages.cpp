#include <bdpt/memory/huge_pages.h>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#endif

namespace bdpt {

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
