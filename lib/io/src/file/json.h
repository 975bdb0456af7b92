#pragma once

#include <bdpt/error.h>
#include <bdpt/io/read_limits.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "file/read_file.h"

namespace bdpt::io {

using Json = nlohmann::json;

/// Parses one JSON text. Throws `Error` (invalid_input) if it is malformed, names a key twice in
/// one object, or is longer, deeper or larger than the limits allow.
[[nodiscard]] Json parse_json(ByteView text, const ReadLimits& limits);

/// A value in a JSON document with its place. Refers to its parent and to the document, which must
/// outlive it.
class JsonPlace {
public:
    explicit JsonPlace(const Json& root) : value_(&root) {}

    [[nodiscard]] const Json& value() const { return *value_; }
    /// Returns the place as a JSON pointer [RFC 6901]; empty for the root.
    [[nodiscard]] std::string pointer() const;

    [[nodiscard]] bool has(std::string_view key) const;
    /// Returns member `key`, which must exist.
    [[nodiscard]] JsonPlace member(std::string_view key) const&;
    JsonPlace member(std::string_view key) const&& = delete;  // would outlive its parent
    /// Returns element `index`, which must be in range.
    [[nodiscard]] JsonPlace element(std::size_t index) const&;
    JsonPlace element(std::size_t index) const&& = delete;
    /// Returns the number of elements; 0 if this is no array.
    [[nodiscard]] std::size_t size() const { return value_->is_array() ? value_->size() : 0; }

    /// Returns the integer, which must not be negative. Throws `Error` (invalid_input).
    [[nodiscard]] std::uint64_t as_unsigned() const;
    /// Returns the integer in member `key`, or `fallback` if there is none.
    [[nodiscard]] std::uint64_t unsigned_or(std::string_view key, std::uint64_t fallback) const;

    /// Throws `Error` whose message is the pointer and `what`.
    [[noreturn]] void fail(const std::string& what,
                           ErrorCode code = ErrorCode::invalid_input) const;

private:
    JsonPlace(const JsonPlace* parent, std::string_view key, std::size_t index, const Json* value)
        : parent_(parent), key_(key), index_(index), value_(value)
    {}

    const JsonPlace* parent_ = nullptr;
    std::string_view key_;   // empty in an array
    std::size_t index_ = 0;  // in an array
    const Json* value_ = nullptr;
};

/// Returns the value in a few characters, for messages.
[[nodiscard]] std::string brief(const Json& value);

/// JSON whose objects keep the order of the text. Finding a key takes time linear in their number.
using OrderedJson = nlohmann::ordered_json;

/// Parses one JSON text, as `parse_json` does.
[[nodiscard]] OrderedJson parse_ordered_json(ByteView text, const ReadLimits& limits);

/// Returns the value in a few characters, for messages.
[[nodiscard]] std::string brief(const OrderedJson& value);

}  // namespace bdpt::io
