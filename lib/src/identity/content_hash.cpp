#include <bdpt/part/content_hash.h>

#include <array>
#include <cstdio>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace bdpt {

struct ContentHasher::State {
    XXH3_state_t xxh3;
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>())
{
    XXH3_128bits_reset(&state_->xxh3);
}

ContentHasher::~ContentHasher() = default;

void ContentHasher::add(const void* bytes, std::size_t size)
{
    XXH3_128bits_update(&state_->xxh3, bytes, size);
}

ContentHash ContentHasher::hash() const
{
    const XXH128_hash_t hash = XXH3_128bits_digest(&state_->xxh3);
    return {.low = hash.low64, .high = hash.high64};
}

std::string to_string(const ContentHash& hash)
{
    std::array<char, 33> text{};
    std::snprintf(text.data(), text.size(), "%016llx%016llx",
                  static_cast<unsigned long long>(hash.high),
                  static_cast<unsigned long long>(hash.low));
    return text.data();
}

}  // namespace bdpt
