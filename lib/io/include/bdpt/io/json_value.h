#pragma once

/// @file
/// Reads JSON that anybody may have changed.
///
/// @code{.cpp}
/// const bdpt::io::JsonValue job = bdpt::io::JsonValue::read("job.json");
/// bdpt::RenderOptions options;
/// options.film.width = job.at("width").number<int>(1, 65536);  // throws for other values
/// options.film.height = job.at("height").number<int>(1, 65536);
/// @endcode

#include <bdpt/export.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bdpt::io {

/// A value in a JSON text that bdpt writes for itself, such as a plan or the header of a part, but
/// that anybody may have changed or forged. All reading is checked: a member that is missing, of
/// another type or out of range throws an `Error` (invalid_input) that names the place as a JSON
/// pointer [RFC 6901], the expected and the found value. A copy shares the document.
class BDPT_EXPORT JsonValue {
public:
    // Limits of a document. Reading takes time linear in its length.
    static constexpr std::uint64_t max_bytes = std::uint64_t{64} << 20;
    static constexpr std::size_t max_depth = 16;
    static constexpr std::size_t max_values = 16'000'000;

    /// Parses a text. Throws `Error` (invalid_input) if it is no JSON, names a key twice in one
    /// object, or is beyond the limits.
    [[nodiscard]] static JsonValue parse(std::string_view text);
    /// Parses a regular file. Errors start with its path, also those of values in it. Throws
    /// `Error` like `parse`, and (not_found).
    [[nodiscard]] static JsonValue read(const std::filesystem::path& file);

    [[nodiscard]] bool is_null() const;
    [[nodiscard]] bool is_object() const;
    [[nodiscard]] bool is_array() const;
    [[nodiscard]] bool is_text() const;
    [[nodiscard]] bool has(std::string_view key) const;
    [[nodiscard]] JsonValue at(std::string_view key) const;
    [[nodiscard]] JsonValue at(std::size_t index) const;
    /// Returns the elements of an array.
    [[nodiscard]] std::vector<JsonValue> elements() const;
    /// Returns the members of an object, in the order of the text.
    [[nodiscard]] std::vector<std::pair<std::string, JsonValue>> members() const;

    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::vector<std::string> texts() const;
    /// Returns a scalar as text: a string itself, a number, true or false as its JSON.
    [[nodiscard]] std::string scalar_text() const;
    /// Returns a number in [low, high]. Integers have no fraction and no exponent; floats and
    /// doubles are finite. For int, std::int64_t, std::uint32_t, std::uint64_t, float and double.
    template <typename Number>
    [[nodiscard]] Number number(Number low = std::numeric_limits<Number>::lowest(),
                                Number high = std::numeric_limits<Number>::max()) const;

    /// Throws `Error` (invalid_input) with the place and `what` is wrong there.
    [[noreturn]] void fail(std::string_view what) const;
    /// Throws `Error` (invalid_input) with the place and what was `expected` there.
    [[noreturn]] void fail_expecting(std::string_view expected) const;

private:
    JsonValue(std::shared_ptr<const void> value, std::string place)
        : value_(std::move(value)), place_(std::move(place))
    {}

    std::shared_ptr<const void> value_;  // keeps the document alive
    std::string place_;                  // JSON pointer of the value, after the name of the file
};

}  // namespace bdpt::io
