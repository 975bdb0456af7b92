#include "report/viewer/tev_message.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace bdpt::app {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are sent as they are in memory");

enum class MessageKind : std::uint8_t { create_image = 4, update_image = 6 };

constexpr std::array<std::string_view, 3> channels{"R", "G", "B"};

/// Builds a message with its length in front.
class Message {
public:
    explicit Message(MessageKind kind)
    {
        add(std::uint32_t{0});
        add(static_cast<std::uint8_t>(kind));
    }
    template <typename Number>
    void add(Number number)
    {
        static_assert(std::is_arithmetic_v<Number>);
        std::array<char, sizeof number> bytes{};
        std::memcpy(bytes.data(), &number, sizeof number);
        bytes_.append(bytes.data(), bytes.size());
    }
    void add(std::string_view text)
    {
        bytes_.append(text.substr(0, text.find('\0')));
        bytes_.push_back('\0');
    }
    void add_channels()
    {
        add(static_cast<std::int32_t>(channels.size()));
        for (const std::string_view channel : channels) {
            add(channel);
        }
    }
    void add(std::span<const Rgb> pixels)
    {
        const std::size_t before = bytes_.size();
        bytes_.resize(before + pixels.size_bytes());
        std::memcpy(bytes_.data() + before, pixels.data(), pixels.size_bytes());
    }
    [[nodiscard]] std::string done() &&
    {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return std::move(bytes_);
    }

private:
    std::string bytes_;
};

constexpr std::uint8_t keep_focus = 0;  // the user's selected image stays in front

}  // namespace

std::string tev_create_image(std::string_view name, int width, int height)
{
    Message message(MessageKind::create_image);
    message.add(keep_focus);
    message.add(name);
    message.add(std::int32_t{width});
    message.add(std::int32_t{height});
    message.add_channels();
    return std::move(message).done();
}

std::string tev_update_image(std::string_view name, const Image& image, int x, int y, int first_row,
                             int end_row)
{
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    Message message(MessageKind::update_image);
    message.add(keep_focus);
    message.add(name);
    message.add_channels();
    message.add(std::int32_t{x});
    message.add(std::int32_t{y + first_row});
    message.add(std::int32_t{image.width});
    message.add(std::int32_t{end_row - first_row});
    for (std::int64_t channel = 0; channel < 3; ++channel) {
        message.add(channel);  // offset of its first value
    }
    for (int channel = 0; channel < 3; ++channel) {
        message.add(std::int64_t{3});  // stride of its values
    }
    const auto width = static_cast<std::size_t>(image.width);
    message.add(std::span(image.pixels)
                    .subspan(static_cast<std::size_t>(first_row) * width,
                             static_cast<std::size_t>(end_row - first_row) * width));
    return std::move(message).done();
}

}  // namespace bdpt::app
