#include "file/uri.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

namespace bdpt::io {

namespace {

constexpr std::uint8_t not_base64 = 255;

constexpr std::array<std::uint8_t, 256> base64_table = [] {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<std::uint8_t, 256> table{};
    table.fill(not_base64);
    for (std::size_t i = 0; i < digits.size(); ++i) {
        table[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
    }
    // The alphabet for file names and URIs [RFC 4648, sec. 5], which some exporters use.
    table[static_cast<unsigned char>('-')] = 62;
    table[static_cast<unsigned char>('_')] = 63;
    return table;
}();

Bytes decode_base64(std::string_view text)
{
    while (!text.empty() && text.back() == '=') {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("base64 text of {} digits is truncated", text.size()));
    }
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t word = 0;
    int bits = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::uint8_t digit = base64_table[static_cast<unsigned char>(text[i])];
        if (digit == not_base64) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("base64 digit {}: byte 0x{:02x} is not a base64 digit", i,
                                    static_cast<unsigned char>(text[i])));
        }
        word = (word << 6) | digit;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::uint8_t>((word >> bits) & 0xffu));
        }
    }
    return bytes;
}

int hex_value(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const int lower = std::tolower(static_cast<unsigned char>(c));
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

bool has_scheme(std::string_view uri)
{
    const std::size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0 ||
        std::isalpha(static_cast<unsigned char>(uri[0])) == 0) {
        return false;
    }
    return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
    });
}

/// Tests whether `file` lies below `folder`; both are canonical.
bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder)
{
    const auto [end, _] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
}

}  // namespace

bool is_data_uri(std::string_view uri)
{
    constexpr std::string_view scheme = "data:";
    return uri.size() >= scheme.size() &&
           std::equal(scheme.begin(), scheme.end(), uri.begin(), [](char a, char b) {
               return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
           });
}

Bytes decode_data_uri(std::string_view uri, std::uint64_t limit)
{
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        throw Error(ErrorCode::invalid_input, "data URI without a comma: " + quote(uri));
    }
    const std::string_view header = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    const bool base64 = header.ends_with(";base64");
    const std::uint64_t size = base64 ? body.size() / 4 * 3 : body.size();
    if (size > limit) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("data URI of {} bytes, but the limit is {}", size, limit));
    }
    if (base64 && body.find('%') == std::string_view::npos) {
        return decode_base64(body);
    }
    const std::string decoded = percent_decode(body);
    return base64 ? decode_base64(decoded) : Bytes(decoded.begin(), decoded.end());
}

std::string percent_decode(std::string_view text)
{
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size()) {
            const int high = hex_value(text[i + 1]);
            const int low = hex_value(text[i + 2]);
            if (high >= 0 && low >= 0) {
                decoded.push_back(static_cast<char>(high * 16 + low));
                i += 2;
                continue;
            }
        }
        decoded.push_back(text[i]);
    }
    return decoded;
}

std::filesystem::path resolve_uri(const std::filesystem::path& folder, std::string_view uri)
{
    const auto refuse = [&uri](std::string_view why) {
        throw Error(ErrorCode::invalid_input, fmt::format("{}: {}", quote(uri), why));
    };
    if (uri.empty()) {
        refuse("an empty URI");
    }
    if (has_scheme(uri)) {
        refuse("only relative and data URIs are read");
    }
    const std::string decoded = percent_decode(uri);
    if (decoded.find('\0') != std::string::npos) {
        refuse("a URI with a zero byte");
    }
    const std::filesystem::path relative(decoded);
    if (relative.is_absolute() || decoded.front() == '\\') {
        refuse("an absolute path; only files in the scene's folder are read");
    }
    std::error_code error;
    const std::filesystem::path root =
        std::filesystem::canonical(folder.empty() ? std::filesystem::path(".") : folder, error);
    if (error) {
        refuse("the scene's folder cannot be read: " + error.message());
    }
    const std::filesystem::path file = std::filesystem::weakly_canonical(root / relative, error);
    if (error) {
        refuse(error.message());
    }
    if (!is_below(file, root)) {
        refuse("outside of the scene's folder; only files in it are read");
    }
    return file;
}

std::string quote(std::string_view text)
{
    constexpr std::size_t longest = 80;
    std::string shown = "\"";
    for (const char c : text.substr(0, longest)) {
        shown.push_back(std::iscntrl(static_cast<unsigned char>(c)) != 0 ? '?' : c);
    }
    return shown + (text.size() > longest ? "...\"" : "\"");
}

}  // namespace bdpt::io
