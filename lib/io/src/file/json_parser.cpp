#include "file/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <vector>

#include "file/read_file.h"

namespace bdpt::io {

namespace {

/// Shortens the parser's message to one printable line: of "[json.exception...] parse error at line
/// 1, column 3: syntax error while parsing value - unexpected ..." the place and the text after the
/// dash.
std::string explanation(std::string_view text)
{
    constexpr std::size_t longest = 200;
    constexpr std::string_view error_at = "parse error at ";
    if (const std::size_t tag = text.find("] "); tag != std::string_view::npos) {
        text.remove_prefix(tag + 2);
    }
    std::string place;
    if (text.starts_with(error_at)) {
        text.remove_prefix(error_at.size());
        const std::size_t dash = text.find(" - ");
        if (const std::size_t colon = text.find(": ");
            colon < dash && dash != std::string_view::npos) {
            place = text.substr(0, colon + 2);
            text.remove_prefix(dash + 3);
        }
    }
    std::string line = place + std::string(text.substr(0, longest));
    for (char& c : line) {
        c = c < ' ' || c > '~' ? '?' : c;
    }
    return line;
}

[[noreturn]] void refuse_second(std::string_view key)
{
    throw Error(ErrorCode::invalid_input,
                "JSON: the key " + quote(key) + " occurs twice in one object");
}

/// Adds a member to an object that is sorted by its keys.
Json* add_member(Json& object, std::string& key)
{
    const auto [slot, inserted] = object.emplace(key, nullptr);
    if (!inserted) {
        refuse_second(key);
    }
    return &*slot;
}

/// Adds a member to an object that keeps the order of its keys. It does not search them for the new
/// one: `check_members` checks all at once.
OrderedJson* add_member(OrderedJson& object, std::string& key)
{
    return &object.get_ref<OrderedJson::object_t&>().emplace_back(std::move(key), nullptr).second;
}

void check_members(const Json& /*object*/) {}

void check_members(const OrderedJson& object)
{
    std::vector<std::string_view> keys;
    keys.reserve(object.size());
    for (const auto& [key, member] : object.get_ref<const OrderedJson::object_t&>()) {
        keys.emplace_back(key);
    }
    std::sort(keys.begin(), keys.end());
    const auto second = std::adjacent_find(keys.begin(), keys.end());
    if (second != keys.end()) {
        refuse_second(*second);
    }
}

/// Builds the document from the parser's events and stops at the limits. The parser is not
/// recursive, so depth takes no stack before it is refused.
template <typename Document>
class LimitedBuilder {
public:
    LimitedBuilder(const ReadLimits& limits, std::size_t size) : limits_(limits), size_(size) {}

    [[nodiscard]] Document take() { return std::move(root_); }

    bool null() { return add(nullptr); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(typename Document::number_integer_t value) { return add(value); }
    bool number_unsigned(typename Document::number_unsigned_t value) { return add(value); }
    bool number_float(typename Document::number_float_t value, const std::string&)
    {
        return add(value);
    }
    bool string(std::string& value) { return add(std::move(value)); }
    bool binary(typename Document::binary_t&) { return false; }

    bool start_object(std::size_t) { return open(Document::object()); }
    bool end_object()
    {
        check_members(*open_.back());
        return close();
    }
    bool start_array(std::size_t) { return open(Document::array()); }
    bool end_array() { return close(); }

    bool key(std::string& name)
    {
        slot_ = add_member(*open_.back(), name);
        return true;
    }

    bool parse_error(std::size_t byte, const std::string&, const std::exception& error)
    {
        if (byte > size_) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("JSON: ends in the middle, after {} bytes: it was cut off, or "
                                    "a bracket or quote is not closed",
                                    size_));
        }
        throw Error(ErrorCode::invalid_input,
                    fmt::format("JSON: byte {}: {}", byte, explanation(error.what())));
    }

private:
    Document* put(Document value)
    {
        if (++values_ > limits_.json_values) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("JSON: more than {} values", limits_.json_values));
        }
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        if (open_.back()->is_array()) {
            open_.back()->push_back(std::move(value));
            return &open_.back()->back();
        }
        *slot_ = std::move(value);
        return slot_;
    }

    bool add(Document value)
    {
        put(std::move(value));
        return true;
    }

    bool open(Document value)
    {
        if (open_.size() >= limits_.json_depth) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("JSON: nested deeper than {}", limits_.json_depth));
        }
        // Elements of an array move when it grows, but never while one of them is open.
        open_.push_back(put(std::move(value)));
        return true;
    }

    bool close()
    {
        open_.pop_back();
        return true;
    }

    ReadLimits limits_;
    std::size_t size_;  // bytes of the text
    Document root_;
    std::vector<Document*> open_;
    Document* slot_ = nullptr;
    std::size_t values_ = 0;
};

template <typename Document>
Document parse(ByteView text, const ReadLimits& limits)
{
    if (text.size() > limits.json_bytes) {
        throw Error(ErrorCode::invalid_input, fmt::format("JSON of {} bytes, but the limit is {}",
                                                          text.size(), limits.json_bytes));
    }
    LimitedBuilder<Document> builder(limits, text.size());
    if (!Document::sax_parse(text.begin(), text.end(), &builder)) {
        throw Error(ErrorCode::invalid_input, "JSON: malformed");
    }
    return builder.take();
}

}  // namespace

Json parse_json(ByteView text, const ReadLimits& limits)
{
    return parse<Json>(text, limits);
}

OrderedJson parse_ordered_json(ByteView text, const ReadLimits& limits)
{
    return parse<OrderedJson>(text, limits);
}

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
