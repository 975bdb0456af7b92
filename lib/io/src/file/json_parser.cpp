#include "file/json.h"
#include "file/uri.h"

#include <fmt/format.h>

#include <vector>

namespace bdpt::io {

namespace {

/// The parser's own words without their tag ("[json.exception...] "), in one printable line.
std::string explanation(std::string_view text)
{
    constexpr std::size_t longest = 200;
    if (const std::size_t tag = text.find("] "); tag != std::string_view::npos) {
        text.remove_prefix(tag + 2);
    }
    std::string line(text.substr(0, longest));
    for (char& c : line) {
        c = c < ' ' || c > '~' ? '?' : c;
    }
    return line;
}

/// Builds the document from the parser's events and stops it at the limits. The parser itself is
/// not recursive, so that depth costs no stack before it is refused.
class LimitedBuilder {
public:
    explicit LimitedBuilder(const ReadLimits& limits) : limits_(limits) {}

    [[nodiscard]] Json take() { return std::move(root_); }

    bool null() { return add(nullptr); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(Json::number_integer_t value) { return add(value); }
    bool number_unsigned(Json::number_unsigned_t value) { return add(value); }
    bool number_float(Json::number_float_t value, const std::string&) { return add(value); }
    bool string(std::string& value) { return add(std::move(value)); }
    bool binary(Json::binary_t&) { return false; }

    bool start_object(std::size_t) { return open(Json::object()); }
    bool end_object() { return close(); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_array() { return close(); }

    bool key(std::string& name)
    {
        const auto [slot, inserted] = open_.back()->emplace(name, nullptr);
        if (!inserted) {
            throw Error(ErrorCode::invalid_input,
                        "JSON: the key " + quote(name) + " stands twice in one object");
        }
        slot_ = &*slot;
        return true;
    }

    bool parse_error(std::size_t byte, const std::string&, const std::exception& error)
    {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("JSON: byte {}: {}", byte, explanation(error.what())));
    }

private:
    Json* put(Json value)
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

    bool add(Json value)
    {
        put(std::move(value));
        return true;
    }

    bool open(Json value)
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
    Json root_;
    std::vector<Json*> open_;
    Json* slot_ = nullptr;
    std::size_t values_ = 0;
};

}  // namespace

Json parse_json(ByteView text, const ReadLimits& limits)
{
    if (text.size() > limits.json_bytes) {
        throw Error(ErrorCode::invalid_input, fmt::format("JSON of {} bytes, but the limit is {}",
                                                          text.size(), limits.json_bytes));
    }
    LimitedBuilder builder(limits);
    if (!Json::sax_parse(text.begin(), text.end(), &builder)) {
        throw Error(ErrorCode::invalid_input, "JSON: malformed");
    }
    return builder.take();
}

}  // namespace bdpt::io
