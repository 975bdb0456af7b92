#include "mutator.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::fuzz {

namespace {

using Bytes = std::vector<std::uint8_t>;

/// SplitMix64 [Steele, Lea and Flood 2014]: a stream for each seed, the same on every machine.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    [[nodiscard]] std::uint64_t next()
    {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, n); n must not be 0.
    [[nodiscard]] std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }

private:
    std::uint64_t state_;
};

/// Values that sit at the borders of types, of rules, or of memory.
constexpr std::string_view extreme_values[] = {"-1",
                                               "0",
                                               "1",
                                               "2",
                                               "3",
                                               "4",
                                               "7",
                                               "16",
                                               "255",
                                               "256",
                                               "5120",
                                               "5121",
                                               "5123",
                                               "5125",
                                               "5126",
                                               "65535",
                                               "65536",
                                               "2147483647",
                                               "2147483648",
                                               "4294967295",
                                               "4294967296",
                                               "9223372036854775807",
                                               "18446744073709551615",
                                               "1e15",
                                               "3e38",
                                               "1e39",
                                               "1e308",
                                               "1e-45",
                                               "-0.0",
                                               "0.5",
                                               "null",
                                               "true",
                                               "\"\"",
                                               "[]",
                                               "{}",
                                               "[0]"};
constexpr std::array<std::uint32_t, 12> extreme_words{
    0u,          1u,          0x7fu,       0xffu,       0xffffu,     0x7fffffffu,
    0x80000000u, 0xffffffffu, 0x7f800000u, 0xff800000u, 0x7fc00000u, 0x7f7fffffu};

struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
};

Range random_range(std::size_t size, std::size_t longest, Random& random)
{
    const std::size_t begin = random.below(size);
    return {begin, begin + 1 + random.below(std::min(longest, size - begin))};
}

auto at(Bytes& bytes, std::size_t index)
{
    return bytes.begin() + static_cast<std::ptrdiff_t>(index);
}

void mutate_bytes(Bytes& bytes, Random& random)
{
    if (bytes.empty()) {
        bytes.push_back(static_cast<std::uint8_t>(random.next()));
        return;
    }
    const Range range = random_range(bytes.size(), 64, random);
    switch (random.below(7)) {
        case 0:
            bytes[range.begin] ^= static_cast<std::uint8_t>(1u << random.below(8));
            break;
        case 1:
            bytes[range.begin] = static_cast<std::uint8_t>(random.next());
            break;
        case 2: {
            const std::uint32_t word = extreme_words[random.below(extreme_words.size())];
            const std::size_t room = std::min<std::size_t>(4, bytes.size() - range.begin);
            std::memcpy(bytes.data() + range.begin, &word, room);
            break;
        }
        case 3:
            bytes.resize(range.begin);
            break;
        case 4:
            bytes.erase(at(bytes, range.begin), at(bytes, range.end));
            break;
        case 5: {
            const Bytes copy(at(bytes, range.begin), at(bytes, range.end));
            bytes.insert(at(bytes, random.below(bytes.size() + 1)), copy.begin(), copy.end());
            break;
        }
        default:
            for (std::size_t i = range.begin; i < range.end; ++i) {
                bytes[i] = static_cast<std::uint8_t>(random.next());
            }
    }
}

bool is_part_of_word(char c)
{
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' ||
           c == '+' || c == '.' || c == '_';
}

/// Numbers, names and key words of JSON text, without looking at its grammar.
std::vector<Range> find_words(std::string_view text)
{
    std::vector<Range> words;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && is_part_of_word(text[end])) {
            ++end;
        }
        // Long ones are data URIs.
        if (end > i && end - i < 64) {
            words.push_back({i, end});
        }
        i = std::max(end, i + 1);
    }
    return words;
}

std::optional<Range> random_number(std::string_view text, const std::vector<Range>& words,
                                   Random& random)
{
    for (int attempt = 0; attempt < 16; ++attempt) {
        const Range& word = words[random.below(words.size())];
        const char first = text[word.begin];
        if ((first >= '0' && first <= '9') || first == '-') {
            return word;
        }
    }
    return std::nullopt;
}

void mutate_text(std::string& text, Random& random)
{
    const std::vector<Range> words = find_words(text);
    if (words.empty()) {
        return;
    }
    const Range& other = words[random.below(words.size())];
    const std::string other_text = text.substr(other.begin, other.end - other.begin);
    const std::optional<Range> number = random_number(text, words, random);
    const std::size_t choice = random.below(4);
    if (choice == 0 || !number) {
        const Range& word = words[random.below(words.size())];
        text.replace(word.begin, word.end - word.begin, other_text);
        return;
    }
    const std::string_view extreme = extreme_values[random.below(std::size(extreme_values))];
    text.replace(number->begin, number->end - number->begin,
                 choice == 1 ? other_text : std::string(extreme));
}

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset)
{
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

void append_word(Bytes& bytes, std::uint32_t word)
{
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof word);
    std::memcpy(bytes.data() + end, &word, sizeof word);
}

struct Glb {
    std::string json;
    Bytes rest;  ///< all chunks after it
};

std::optional<Glb> split_glb(std::span<const std::uint8_t> bytes)
{
    constexpr std::uint32_t magic = 0x46546c67;
    constexpr std::size_t head = 20;
    if (bytes.size() < head || word_at(bytes, 0) != magic) {
        return std::nullopt;
    }
    const std::size_t length = word_at(bytes, 12);
    if (length > bytes.size() - head) {
        return std::nullopt;
    }
    const auto json = bytes.subspan(head, length);
    const auto rest = bytes.subspan(head + length);
    return Glb{std::string(json.begin(), json.end()), Bytes(rest.begin(), rest.end())};
}

Bytes join_glb(Glb glb)
{
    glb.json.resize((glb.json.size() + 3) / 4 * 4, ' ');
    // A changed BIN chunk keeps a length that fits.
    if (glb.rest.size() >= 8) {
        const auto size = static_cast<std::uint32_t>(glb.rest.size() - 8);
        std::memcpy(glb.rest.data(), &size, sizeof size);
    }
    Bytes bytes{'g', 'l', 'T', 'F', 2, 0, 0, 0};
    append_word(bytes, static_cast<std::uint32_t>(20 + glb.json.size() + glb.rest.size()));
    append_word(bytes, static_cast<std::uint32_t>(glb.json.size()));
    append_word(bytes, 0x4e4f534a);
    bytes.insert(bytes.end(), glb.json.begin(), glb.json.end());
    bytes.insert(bytes.end(), glb.rest.begin(), glb.rest.end());
    return bytes;
}

Bytes mutate_once(Bytes bytes, Random& random)
{
    const std::size_t choice = random.below(8);
    if (std::optional<Glb> glb = split_glb(bytes); glb && choice > 0) {
        if (choice < 5) {
            mutate_text(glb->json, random);
        } else {
            mutate_bytes(glb->rest, random);
        }
        return join_glb(std::move(*glb));
    }
    if (!bytes.empty() && bytes[0] == '{' && choice > 0) {
        std::string text(bytes.begin(), bytes.end());
        mutate_text(text, random);
        return {text.begin(), text.end()};
    }
    mutate_bytes(bytes, random);
    return bytes;
}

}  // namespace

std::vector<std::uint8_t> mutate(std::span<const std::uint8_t> input, std::uint64_t seed,
                                 std::size_t most)
{
    Random random(seed);
    Bytes bytes(input.begin(), input.end());
    const std::size_t changes = 1 + random.below(4);
    for (std::size_t i = 0; i < changes; ++i) {
        bytes = mutate_once(std::move(bytes), random);
    }
    bytes.resize(std::min(bytes.size(), most));
    return bytes;
}

}  // namespace bdpt::fuzz
