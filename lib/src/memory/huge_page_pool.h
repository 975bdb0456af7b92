#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace bdpt {

/// Memory of many blocks in large pages, for blocks that are smaller than such a page. Blocks begin
/// at cache lines and share none. What is freed is reused for blocks of the same size; all memory
/// is returned with the pool. Threads may share it.
class HugePagePool {
public:
    /// Returns a block of at least one byte.
    [[nodiscard]] void* allocate(std::size_t bytes);
    void free(void* block, std::size_t bytes) noexcept;

    static constexpr std::size_t cache_line = 64;  ///< of most processors [bytes]

private:
    struct Freed {
        Freed* next;
    };
    struct Release {
        void operator()(std::byte* slab) const noexcept;
    };
    using Slab = std::unique_ptr<std::byte, Release>;

    std::mutex mutex_;
    std::vector<Slab> slabs_;
    std::byte* next_ = nullptr;  // unused part of the last slab
    std::size_t left_ = 0;
    std::map<std::size_t, Freed*> free_;  // lists by size
};

/// Allocates the values of a container from a pool, which must outlive it.
template <typename T>
class PoolAllocator {
public:
    using value_type = T;

    explicit PoolAllocator(HugePagePool& pool) noexcept : pool_(&pool) {}
    template <typename Other>
    PoolAllocator(const PoolAllocator<Other>& other) noexcept : pool_(&other.pool())
    {}

    [[nodiscard]] T* allocate(std::size_t count)
    {
        static_assert(alignof(T) <= HugePagePool::cache_line);
        return static_cast<T*>(pool_->allocate(count * sizeof(T)));
    }
    void deallocate(T* values, std::size_t count) noexcept
    {
        pool_->free(values, count * sizeof(T));
    }
    [[nodiscard]] HugePagePool& pool() const noexcept { return *pool_; }
    [[nodiscard]] bool operator==(const PoolAllocator& other) const noexcept = default;

private:
    HugePagePool* pool_;
};

}  // namespace bdpt
