#include "file/read_file.h"

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

/// Decodes base64, in which white space is ignored.
Bytes decode_base64(std::string_view text)
{
    const auto is_space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && (text.back() == '=' || is_space(text.back()))) {
        text.remove_suffix(1);
    }
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t word = 0;
    int bits = 0;
    std::size_t digits = 0;
    for (const char c : text) {
        if (is_space(c)) {
            continue;
        }
        const std::uint8_t digit = base64_table[static_cast<unsigned char>(c)];
        if (digit == not_base64) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("base64 digit {}: byte 0x{:02x} is not a base64 digit", digits,
                                    static_cast<unsigned char>(c)));
        }
        ++digits;
        word = (word << 6) | digit;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::uint8_t>((word >> bits) & 0xffu));
        }
    }
    if (digits % 4 == 1) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("base64 text of {} digits is truncated", digits));
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

/// Tests whether `text` in lower case equals `lower`.
bool equal_in_lower_case(std::string_view text, std::string_view lower)
{
    return std::equal(text.begin(), text.end(), lower.begin(), lower.end(), [](char a, char b) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(a))) == b;
    });
}

/// Tests whether the part of a data URI before the comma ends with ";base64" [RFC 2397], in letters
/// of any case and with spaces, as the URL standard of WHATWG permits.
bool ends_with_base64(std::string_view header)
{
    constexpr std::string_view token = "base64";
    const auto trim = [&header] {
        while (header.ends_with(' ')) {
            header.remove_suffix(1);
        }
    };
    trim();
    if (header.size() < token.size() ||
        !equal_in_lower_case(header.substr(header.size() - token.size()), token)) {
        return false;
    }
    header.remove_suffix(token.size());
    trim();
    return header.ends_with(';');
}

/// Tests whether `file` lies below `folder`; both are canonical.
bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder)
{
    const auto [end, _] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
}

/// Tests whether `file`, which is canonical, lies below one of `folders`.
bool is_in_one(const std::filesystem::path& file, const std::vector<std::filesystem::path>& folders)
{
    return std::any_of(folders.begin(), folders.end(), [&file](const auto& folder) {
        std::error_code error;
        const std::filesystem::path root = std::filesystem::canonical(folder, error);
        return !error && is_below(file, root);
    });
}

}  // namespace

bool is_data_uri(std::string_view uri)
{
    constexpr std::string_view scheme = "data:";
    return equal_in_lower_case(uri.substr(0, scheme.size()), scheme);
}

Bytes decode_data_uri(std::string_view uri, std::uint64_t limit)
{
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        throw Error(ErrorCode::invalid_input, "data URI without a comma: " + quote(uri));
    }
    const std::string_view header = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    const bool base64 = ends_with_base64(header);
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

void check_folders(const SceneFolders& folders)
{
    for (const std::filesystem::path& folder : folders.allowed) {
        std::error_code error;
        if (!std::filesystem::is_directory(folder, error)) {
            throw Error(ErrorCode::not_found,
                        fmt::format("--allow-folder {}: no such folder", quote(folder.string())));
        }
    }
}

std::filesystem::path resolve_uri(const SceneFolders& folders, std::string_view uri)
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
    if (decoded.front() == '/' || decoded.front() == '\\') {
        refuse("an absolute path; only files in the scene's folder are read");
    }
    std::error_code error;
    const std::filesystem::path root = std::filesystem::canonical(
        folders.own.empty() ? std::filesystem::path(".") : folders.own, error);
    if (error) {
        refuse("the scene's folder cannot be read: " + error.message());
    }
    const auto find = [&](const std::string& name) {
        std::filesystem::path file = std::filesystem::weakly_canonical(root / name, error);
        if (error) {
            refuse(error.message());
        }
        return file;
    };
    const auto may_read = [&](const std::filesystem::path& file) {
        return is_below(file, root) || is_in_one(file, folders.allowed);
    };
    const std::filesystem::path file = find(decoded);
    if (decoded.find('\\') != std::string::npos && !std::filesystem::exists(file, error)) {
        std::string slashes = decoded;
        std::replace(slashes.begin(), slashes.end(), '\\', '/');
        const std::filesystem::path other = find(slashes);
        if (may_read(other) && std::filesystem::exists(other, error)) {
            return other;
        }
    }
    if (!may_read(file)) {
        const bool by_link = is_below((root / decoded).lexically_normal(), root);
        refuse(fmt::format("{} {}, outside of the scene's folder; --allow-folder allows others",
                           by_link ? "is a link to" : "leads to", quote(file.string())));
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
