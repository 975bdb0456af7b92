#include <bdpt/io/json_value.h>

#include "file/json.h"
#include "file/messages.h"
#include "file/read_file.h"

#include <bdpt/error.h>
#include <fmt/format.h>

#include <concepts>
#include <utility>

namespace bdpt::io {

namespace {

ReadLimits limits()
{
    ReadLimits result;
    result.file_bytes = JsonValue::max_bytes;
    result.json_bytes = JsonValue::max_bytes;
    result.json_depth = JsonValue::max_depth;
    result.json_values = JsonValue::max_values;
    return result;
}

const OrderedJson& node(const std::shared_ptr<const void>& value)
{
    return *static_cast<const OrderedJson*>(value.get());
}

/// Returns `value`, in a document that `document` keeps alive.
std::shared_ptr<const void> shared(const std::shared_ptr<const void>& document,
                                   const OrderedJson& value)
{
    return {document, &value};
}

std::shared_ptr<const void> parsed(ByteView text)
{
    return std::make_shared<const OrderedJson>(parse_ordered_json(text, limits()));
}

/// Tests whether the JSON number fits without a change of its value, apart from rounding to a
/// float.
template <typename Number>
bool is_within(const OrderedJson& value, Number low, Number high)
{
    if constexpr (std::floating_point<Number>) {
        return value.is_number() && value.get<double>() >= static_cast<double>(low) &&
               value.get<double>() <= static_cast<double>(high);
    } else if (value.is_number_unsigned()) {
        return std::cmp_greater_equal(value.get<std::uint64_t>(), low) &&
               std::cmp_less_equal(value.get<std::uint64_t>(), high);
    } else {
        return value.is_number_integer() &&
               std::cmp_greater_equal(value.get<std::int64_t>(), low) &&
               std::cmp_less_equal(value.get<std::int64_t>(), high);
    }
}

}  // namespace

JsonValue JsonValue::parse(std::string_view text)
{
    return {parsed({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}), ""};
}

JsonValue JsonValue::read(const std::filesystem::path& file)
{
    return with_named_errors(file, [&] {
        const ReadLimits limit = limits();
        return JsonValue(parsed(read_file(file, limit.file_bytes)), file.string() + ": ");
    });
}

bool JsonValue::is_null() const
{
    return node(value_).is_null();
}

bool JsonValue::is_object() const
{
    return node(value_).is_object();
}

bool JsonValue::is_array() const
{
    return node(value_).is_array();
}

bool JsonValue::is_text() const
{
    return node(value_).is_string();
}

bool JsonValue::has(std::string_view key) const
{
    return node(value_).is_object() && node(value_).contains(key);
}

JsonValue JsonValue::at(std::string_view key) const
{
    if (!has(key)) {
        fail(fmt::format("has no \"{}\"", key));
    }
    return {shared(value_, node(value_)[std::string(key)]), fmt::format("{}/{}", place_, key)};
}

JsonValue JsonValue::at(std::size_t index) const
{
    if (!node(value_).is_array() || index >= node(value_).size()) {
        fail_expecting(fmt::format("an array of more than {} values", index));
    }
    return {shared(value_, node(value_)[index]), fmt::format("{}/{}", place_, index)};
}

std::vector<JsonValue> JsonValue::elements() const
{
    if (!node(value_).is_array()) {
        fail_expecting("an array");
    }
    std::vector<JsonValue> result;
    result.reserve(node(value_).size());
    for (std::size_t i = 0; i < node(value_).size(); ++i) {
        result.push_back(at(i));
    }
    return result;
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const
{
    if (!node(value_).is_object()) {
        fail_expecting("an object");
    }
    std::vector<std::pair<std::string, JsonValue>> result;
    result.reserve(node(value_).size());
    for (const auto& [key, member] : node(value_).items()) {
        result.emplace_back(key, JsonValue(shared(value_, member), place_ + "/" + quote(key)));
    }
    return result;
}

bool JsonValue::boolean() const
{
    if (!node(value_).is_boolean()) {
        fail_expecting("true or false");
    }
    return node(value_).get<bool>();
}

std::string JsonValue::text() const
{
    if (!node(value_).is_string()) {
        fail_expecting("a text");
    }
    return node(value_).get<std::string>();
}

std::vector<std::string> JsonValue::texts() const
{
    std::vector<std::string> result;
    for (const JsonValue& element : elements()) {
        result.push_back(element.text());
    }
    return result;
}

std::string JsonValue::scalar_text() const
{
    const auto& value = node(value_);
    if (value.is_string()) {
        return value.template get<std::string>();
    }
    if (!value.is_number() && !value.is_boolean()) {
        fail_expecting("a text, a number, true or false");
    }
    return value.dump();
}

template <typename Number>
Number JsonValue::number(Number low, Number high) const
{
    if (!is_within(node(value_), low, high)) {
        fail_expecting(fmt::format("{} from {} to {}",
                                   std::floating_point<Number> ? "a number" : "an integer", low,
                                   high));
    }
    return node(value_).get<Number>();
}

template int JsonValue::number(int, int) const;
template std::int64_t JsonValue::number(std::int64_t, std::int64_t) const;
template std::uint32_t JsonValue::number(std::uint32_t, std::uint32_t) const;
template std::uint64_t JsonValue::number(std::uint64_t, std::uint64_t) const;
template float JsonValue::number(float, float) const;
template double JsonValue::number(double, double) const;

void JsonValue::fail(std::string_view what) const
{
    const bool is_root = place_.empty() || place_.ends_with(": ");
    throw Error(ErrorCode::invalid_input, fmt::format("{}{}{}", place_, is_root ? "" : ": ", what));
}

void JsonValue::fail_expecting(std::string_view expected) const
{
    fail(fmt::format("must be {}, but is {}", expected, brief(node(value_))));
}

}  // namespace bdpt::io
