#include <bdpt/memory/huge_pages.h>

#include "catch.hpp"
#include "memory/huge_page_pool.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace bdpt::huge_pages_test {
namespace {

std::uint8_t pattern(std::size_t i)
{
    return static_cast<std::uint8_t>(i * 7 + i / 251);
}

/// Does the system's list of memory show the address in a part that asked for large pages?
bool asks_for_huge_pages(const void* address)
{
    std::ifstream list("/proc/self/smaps");
    const auto wanted = reinterpret_cast<std::uintptr_t>(address);
    bool within = false;
    for (std::string line; std::getline(list, line);) {
        const std::size_t dash = line.find('-');
        if (dash != std::string::npos && dash < 17 && line.find(' ') > dash) {
            within = std::stoull(line, nullptr, 16) <= wanted &&
                     wanted < std::stoull(line.substr(dash + 1), nullptr, 16);
        } else if (within && line.rfind("VmFlags:", 0) == 0) {
            return line.find(" hg") != std::string::npos;
        }
    }
    return false;
}

bool system_has_huge_pages()
{
    std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
    std::string words;
    std::getline(file, words);
    return words.find("[madvise]") != std::string::npos ||
           words.find("[always]") != std::string::npos;
}

}  // namespace

TEST_CASE("huge pages: memory of any size and place keeps what is stored", "[memory]")
{
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{5000},
                                   std::size_t{1} << 21U, (std::size_t{5} << 20U) + 123}) {
        std::vector<std::uint8_t> values;
        resize_in_huge_pages(values, size);
        REQUIRE(values.size() == size);
        for (std::size_t i = 0; i < size; ++i) {
            values[i] = pattern(i);
        }
        // What is in use may be asked for again, from any address on.
        prefer_huge_pages(values.data(), size);
        prefer_huge_pages(values.data() + size / 3, size - size / 3);
        resize_in_huge_pages(values, 2 * size);
        for (std::size_t i = 0; i < size; ++i) {
            REQUIRE(values[i] == pattern(i));
        }
        for (std::size_t i = size; i < 2 * size; ++i) {
            REQUIRE(values[i] == 0);
        }
    }
    prefer_huge_pages(nullptr, 0);
    prefer_huge_pages(nullptr, std::size_t{1} << 22U);  // which the system refuses
}

TEST_CASE("huge pages: the system is asked for them", "[memory]")
{
    if (!system_has_huge_pages()) {
        return;
    }
    std::vector<float> values;
    resize_in_huge_pages(values, std::size_t{8} << 20U);
    CHECK(asks_for_huge_pages(values.data() + values.size() / 2));
}

TEST_CASE("huge page pool: blocks keep what is stored, and share no cache line", "[memory]")
{
    HugePagePool pool;
    constexpr std::size_t sizes[] = {1, 64, 65, 3000, 100'000, (std::size_t{9} << 20U) + 1};
    std::vector<std::pair<std::uint8_t*, std::size_t>> blocks;
    for (std::size_t round = 0; round < 60; ++round) {
        const std::size_t size = sizes[round % std::size(sizes)];
        auto* const block = static_cast<std::uint8_t*>(pool.allocate(size));
        REQUIRE(reinterpret_cast<std::uintptr_t>(block) % HugePagePool::cache_line == 0);
        std::fill_n(block, size, pattern(round));
        blocks.emplace_back(block, size);
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const auto [block, size] = blocks[i];
        REQUIRE(std::count(block, block + size, pattern(i)) == static_cast<std::ptrdiff_t>(size));
    }
    if (system_has_huge_pages()) {
        CHECK(asks_for_huge_pages(blocks[3].first));
    }
    // Blocks of 65 and of 128 bytes have the same lines.
    pool.free(blocks[2].first, 65);
    CHECK(pool.allocate(128) == blocks[2].first);
    CHECK(pool.allocate(128) != blocks[2].first);
}

TEST_CASE("huge page pool: threads share it", "[memory]")
{
    HugePagePool pool;
    std::atomic<int> wrong = 0;
    {
        std::vector<std::jthread> threads;
        for (std::size_t thread = 0; thread < 4; ++thread) {
            threads.emplace_back([&, thread] {
                std::vector<std::size_t, PoolAllocator<std::size_t>> values{
                    PoolAllocator<std::size_t>(pool)};
                for (std::size_t i = 0; i < 20'000; ++i) {
                    values.push_back(thread + 4 * i);
                }
                for (std::size_t i = 0; i < values.size(); ++i) {
                    wrong += values[i] == thread + 4 * i ? 0 : 1;
                }
            });
        }
    }
    CHECK(wrong == 0);
}

}  // namespace bdpt::huge_pages_test
