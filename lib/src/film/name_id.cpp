#include <bdpt/film/name_id.h>

#include <bit>
#include <cstddef>

namespace bdpt {
namespace {

/// Returns the change of the hash by four bytes of the text.
constexpr std::uint32_t scrambled(std::uint32_t block)
{
    return std::rotl(block * 0xcc9e2d51U, 15) * 0x1b873593U;
}

/// Returns at most four bytes from `begin` on, little-endian.
std::uint32_t block_at(std::string_view text, std::size_t begin)
{
    std::uint32_t block = 0;
    for (std::size_t i = 0; i < 4 && begin + i < text.size(); ++i) {
        block |= std::uint32_t{static_cast<unsigned char>(text[begin + i])} << (8 * i);
    }
    return block;
}

/// Returns MurmurHash3_x86_32 with seed 0.
std::uint32_t murmur_hash(std::string_view text)
{
    std::uint32_t hash = 0;
    const std::size_t whole = text.size() / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4) {
        hash = std::rotl(hash ^ scrambled(block_at(text, i)), 13) * 5 + 0xe6546b64U;
    }
    hash ^= scrambled(block_at(text, whole));  // 0 if no bytes are left
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bU;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35U;
    return hash ^ hash >> 16;
}

}  // namespace

NameId name_id(std::string_view name)
{
    const std::uint32_t hash = murmur_hash(name);
    const NameId id{hash};
    return is_name_id(id) ? id : NameId{hash ^ std::uint32_t{1} << 23};
}

std::string hex_text(NameId id)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (int shift = 28; shift >= 0; shift -= 4) {
        text += digits[static_cast<std::uint32_t>(id) >> shift & 0xfU];
    }
    return text;
}

}  // namespace bdpt
