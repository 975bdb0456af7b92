#include "file/json.h"
#include "file/ordered_json.h"
#include "file/uri.h"

#include <fmt/format.h>

namespace bdpt::io {

std::string JsonPlace::pointer() const
{
    if (parent_ == nullptr) {
        return {};
    }
    const std::string before = parent_->pointer();
    if (parent_->value_->is_array()) {
        return before + "/" + std::to_string(index_);
    }
    std::string escaped;
    for (const char c : key_) {
        if (c == '~' || c == '/') {
            escaped += c == '~' ? "~0" : "~1";
        } else {
            escaped.push_back(static_cast<unsigned char>(c) < ' ' ? '?' : c);
        }
    }
    return before + "/" + escaped;
}

bool JsonPlace::has(std::string_view key) const
{
    return value_->is_object() && value_->find(key) != value_->end();
}

JsonPlace JsonPlace::member(std::string_view key) const&
{
    const auto found = value_->find(key);
    return {this, found.key(), 0, &*found};
}

JsonPlace JsonPlace::element(std::size_t index) const&
{
    return {this, {}, index, &(*value_)[index]};
}

std::uint64_t JsonPlace::as_unsigned() const
{
    if (!value_->is_number_unsigned()) {
        fail("must be a non-negative integer, but is " + brief(*value_));
    }
    return value_->get<std::uint64_t>();
}

std::uint64_t JsonPlace::unsigned_or(std::string_view key, std::uint64_t fallback) const
{
    return has(key) ? member(key).as_unsigned() : fallback;
}

void JsonPlace::fail(const std::string& what, ErrorCode code) const
{
    const std::string place = pointer();
    throw Error(code, place.empty() ? what : place + ": " + what);
}

namespace {

template <typename Document>
std::string brief_text(const Document& value)
{
    if (value.is_object() || value.is_array()) {
        return fmt::format("an {} of {}", value.type_name(), value.size());
    }
    if (value.is_string()) {
        return quote(value.template get_ref<const std::string&>());
    }
    return value.dump();
}

}  // namespace

std::string brief(const Json& value)
{
    return brief_text(value);
}

std::string brief(const OrderedJson& value)
{
    return brief_text(value);
}

}  // namespace bdpt::io
