#include "options/groups/image_arguments.h"

#include <bdpt/film/exact_sum.h>
#include <bdpt/film/id_film.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_text.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "options/groups/transport_arguments.h"
#include "options/output_files.h"
#include "options/value_types.h"

namespace bdpt::job {

std::optional<FilterOptions> parse_filter(std::string_view text)
{
    const std::size_t colon = text.find(':');
    const std::optional<FilterKind> kind =
        parse_enumerator<FilterKind>(lower_case(text.substr(0, colon)));
    if (!kind) {
        return std::nullopt;
    }
    FilterOptions result{.kind = *kind, .radius = {}};
    if (colon != std::string_view::npos) {
        result.radius = parse_float(text.substr(colon + 1));
        if (!result.radius || !(*result.radius >= 0.01f && *result.radius <= 16.0f)) {
            return std::nullopt;
        }
    }
    return result;
}

std::optional<AovSet> parse_aovs(std::string_view text)
{
    AovSet result;
    for (const std::string_view part : split(text, ',')) {
        const std::optional<Aov> aov = parse_enumerator<Aov>(lower_case(part));
        if (!aov || *aov == Aov::shadow) {  // requested by --ground
            return std::nullopt;
        }
        result.insert(*aov);
    }
    return result;
}

std::optional<PixelRect> parse_crop(std::string_view text)
{
    constexpr std::size_t largest = 65535;
    std::array<int, 4> corners{};
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != corners.size()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::optional<std::size_t> corner = parse_index(parts[i]);
        if (!corner || *corner > largest) {
            return std::nullopt;
        }
        corners[i] = static_cast<int>(*corner);
    }
    const auto [x0, y0, x1, y1] = corners;
    if (x0 >= x1 || y0 >= y1) {
        return std::nullopt;
    }
    return PixelRect{.x0 = x0, .y0 = y0, .x1 = x1, .y1 = y1};
}

void add_ground_option(OptionList& options, Ground& ground)
{
    const Choices<Ground> grounds{{{"shadow", Ground::shadow}, {"none", Ground::none}}};
    add_choice(options, "--ground",
               "shadow: shadow catcher, a horizontal ground that is invisible itself, also in "
               "reflections. The shadow is black: it darkens the visible environment, or adds to "
               "the alpha of --background; .exr also gets it as layer shadow.A. Default: shadow in "
               ".png, .jpg and .webp files of an object that gets default light, else none",
               ground, grounds);
}

FilmOptions with_ground(Ground ground, FilmOptions film, const OptionList& options)
{
    if (ground != Ground::shadow) {
        if (options.given("--ground-height")) {
            throw OptionError("--ground-height needs --ground shadow");
        }
        return film;
    }
    static constexpr std::array conflicts{Conflict{"--ground", "--fog"},
                                          Conflict{"--ground", "--volume"}};
    check(conflicts, options);
    film.aovs.insert(Aov::shadow);
    return film;
}

namespace {

constexpr std::uint64_t color_sum = 3 * sizeof(ExactSum);
constexpr std::uint64_t shadow_sums = 2 * sizeof(ExactSum) + sizeof(std::uint64_t);

/// Typical cost of a pixel's ids; each further one takes 8 bytes, and the heap's overhead.
constexpr std::uint64_t two_ids = sizeof(IdCounts) + 32;
constexpr std::uint64_t id_channels = 2 * IdFilm::levels;

/// Returns the size of the sums of a pixel in an `AovFilm` or `IdFilm` [bytes].
std::uint64_t count_sum_bytes(const AovLayer& layer)
{
    switch (layer.aov) {
        case Aov::object:
        case Aov::material:
        case Aov::instance:
            return two_ids;
        case Aov::alpha:
            return sizeof(std::uint64_t);
        case Aov::opacity:
            return sizeof(ExactSum);
        case Aov::shadow:
            return shadow_sums;
        default:
            return layer.mean == AovMean::none ? 0 : layer.channels.size() * sizeof(ExactSum);
    }
}

std::uint64_t count_pixels(const RenderOptions& options, const Size& size)
{
    const PixelRect region = options.film.crop.value_or(
        PixelRect{.x0 = 0, .y0 = 0, .x1 = size.width, .y1 = size.height});
    return static_cast<std::uint64_t>(region.width()) * static_cast<std::uint64_t>(region.height());
}

}  // namespace

std::uint64_t film_bytes(const RenderOptions& options, const Size& size)
{
    constexpr std::uint64_t halves = 2;
    std::uint64_t pixel = halves * color_sum + sizeof(Rgb);
    for (const AovLayer& layer : aov_layers) {
        if (options.film.aovs.contains(layer.aov)) {
            const bool is_id = asks_for_ids({layer.aov});
            const std::uint64_t channels = is_id ? id_channels : layer.channels.size();
            // Developed, and once more in the channel order of a file.
            pixel += count_sum_bytes(layer) + 2 * channels * sizeof(float);
        }
    }
    return pixel * count_pixels(options, size);
}

std::uint64_t denoiser_bytes(const RenderOptions& options, const Size& size)
{
    // Measured with version 2.5.1 from 16x16 to 3840x2160; it splits large images into tiles.
    constexpr std::uint64_t program = 100'000'000;
    constexpr std::uint64_t pixel = 700;
    constexpr std::uint64_t most = 3'600'000'000;
    return std::min(program + pixel * count_pixels(options, size), most);
}

namespace {

/// Returns "--light-samples" for "light_samples".
std::string to_flag(std::string_view name)
{
    std::string flag = "--" + std::string(name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

std::string format_range(const Range& range)
{
    if (range.high == std::numeric_limits<double>::infinity()) {
        return fmt::format("a number {} {}", range.low_is_excluded ? "above" : "from", range.low);
    }
    return range.low_is_excluded
               ? fmt::format("a number above {} and up to {}", range.low, range.high)
               : fmt::format("a number from {} to {}", range.low, range.high);
}

template <typename T>
struct Unwrapped {
    using Type = T;
};

template <typename T>
struct Unwrapped<std::optional<T>> {
    using Type = T;
};

/// Returns the value type for a field of type `T`.
template <typename T>
auto value_type(const OptionInfo& info)
{
    if constexpr (std::is_same_v<T, std::uint64_t>) {
        return info.role == OptionRole::limit ? memory_size() : any_seed();
    } else if constexpr (std::is_integral_v<T>) {
        return whole_number(static_cast<std::int64_t>(info.range.low),
                            static_cast<std::int64_t>(info.range.high));
    } else if constexpr (std::is_floating_point_v<T>) {
        return number_within(info.range, format_range(info.range));
    } else if constexpr (std::is_same_v<T, FilterOptions>) {
        return parsed_by(
            parse_filter,
            "box, tent, gaussian or blackman-harris, optionally with a radius from 0.01 "
            "to 16, like gaussian:2");
    } else if constexpr (std::is_same_v<T, AovSet>) {
        return parsed_by(
            parse_aovs,
            "a comma-separated list of albedo, normal, depth, position, samples, variance, alpha, "
            "opacity, object and material");
    } else if constexpr (std::is_same_v<T, SampleRange>) {
        return sample_range();
    } else if constexpr (std::is_same_v<T, PixelRect>) {
        return parsed_by(parse_crop, "four whole numbers x0,y0,x1,y1 with x0 < x1 and y0 < y1");
    } else if constexpr (std::is_same_v<T, std::vector<Strategy>>) {
        return strategies_type();
    } else {
        return choices_of_enumeration<T>().type();
    }
}

template <typename T>
std::string format_value(const OptionInfo& info)
{
    if constexpr (HasEnumerators<T>) {
        return choice_text(choices_of_enumeration<T>().words());
    } else {
        return std::string(info.value);
    }
}

template <typename Field, typename Value>
void add_field(OptionList& options, const Field& field, Value& value)
{
    if (field.info.help.empty()) {
        return;
    }
    using T = typename Unwrapped<Value>::Type;
    const std::string standard =
        field.info.otherwise.empty() ? option_text(value) : std::string(field.info.otherwise);
    options.add(to_flag(field.name), format_value<T>(field.info),
                fmt::format("{}. Default: {}", field.info.help, standard), value,
                value_type<T>(field.info));
}

}  // namespace

template <typename Group>
void add_fields(OptionList& options, Group& group)
{
    for_each_field(group, [&options](const auto& field, auto& value) {
        if constexpr (requires { option_text(value); }) {
            add_field(options, field, value);
        }
    });
}

template void add_fields(OptionList& options, FilmOptions& group);
template void add_fields(OptionList& options, SamplingOptions& group);
template void add_fields(OptionList& options, TransportOptions& group);
template void add_fields(OptionList& options, BidirectionalOptions& group);
template void add_fields(OptionList& options, SystemOptions& group);

void add_fields(OptionList& options, RenderOptions& render, std::span<const std::string_view> names)
{
    for_each_option(render, [&](const auto& field, auto& value) {
        if constexpr (requires { option_text(value); }) {
            if (is_among(names, field.name)) {
                add_field(options, field, value);
            }
        }
    });
}

namespace {

std::optional<float> parse_stops(const std::string& text)
{
    constexpr double most = 100.0;  // 2^100 is far beyond any ratio of a scene to a screen
    const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const std::optional<double> stops = parse_number<double>(has_plus ? text.substr(1) : text);
    return stops && std::abs(*stops) <= most ? std::optional(static_cast<float>(*stops))
                                             : std::nullopt;
}

}  // namespace

std::optional<Exposure> parse_exposure(const std::string& given)
{
    const std::string text = lower_case(given);
    for (const auto& [word, base] :
         {std::pair<std::string, ExposureBase>{"auto", ExposureBase::automatic},
          {"light", ExposureBase::light}}) {
        if (!text.starts_with(word)) {
            continue;
        }
        const std::string more = text.substr(word.size());
        if (more.empty()) {
            return Exposure{.base = base};
        }
        const std::optional<float> stops =
            more[0] == '+' || more[0] == '-' ? parse_stops(more) : std::nullopt;
        return stops ? std::optional(Exposure{.base = base, .value = *stops}) : std::nullopt;
    }
    const std::optional<float> stops = parse_stops(text);
    return stops ? std::optional(Exposure{.value = *stops}) : std::nullopt;
}

namespace {

/// Parses "f0f0f0", or "fff" with each digit doubled.
std::optional<io::SrgbColor> parse_hexadecimal(std::string_view text)
{
    constexpr int hexadecimal = 16;
    io::SrgbColor color{};
    const std::size_t digits = text.size() / color.size();
    if (text.size() % color.size() != 0 || (digits != 1 && digits != 2)) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < color.size(); ++i) {
        const std::string_view part = text.substr(digits * i, digits);
        const auto [stop, error] =
            std::from_chars(part.data(), part.data() + digits, color[i], hexadecimal);
        if (error != std::errc{} || stop != part.data() + digits) {
            return std::nullopt;
        }
        color[i] = static_cast<std::uint8_t>(digits == 1 ? 0x11 * color[i] : color[i]);
    }
    return color;
}

/// Returns the digits of a colour that has a name in CSS, of its first level; empty: none of them.
std::string_view named_digits(std::string_view name)
{
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 19> colors{
        {{"black", "000000"},
         {"silver", "c0c0c0"},
         {"gray", "808080"},
         {"grey", "808080"},
         {"white", "ffffff"},
         {"maroon", "800000"},
         {"red", "ff0000"},
         {"purple", "800080"},
         {"fuchsia", "ff00ff"},
         {"green", "008000"},
         {"lime", "00ff00"},
         {"olive", "808000"},
         {"yellow", "ffff00"},
         {"navy", "000080"},
         {"blue", "0000ff"},
         {"teal", "008080"},
         {"aqua", "00ffff"},
         {"cyan", "00ffff"},
         {"orange", "ffa500"}}};
    for (const auto& [known, digits] : colors) {
        if (known == name) {
            return digits;
        }
    }
    return {};
}

/// Parses "1,0.5,0": fractions of the brightest value of a screen.
std::optional<io::SrgbColor> parse_parts(std::string_view text)
{
    const std::optional<Vec3> parts = parse_vec3(text);
    io::SrgbColor color{};
    for (int i = 0; i < 3; ++i) {
        if (!parts || !((*parts)[i] >= 0.0f && (*parts)[i] <= 1.0f)) {
            return std::nullopt;
        }
        color[static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(std::lround(255.0f * (*parts)[i]));
    }
    return color;
}

}  // namespace

std::optional<Backdrop> parse_backdrop(std::string_view given)
{
    const std::string text = lower_case(given);
    if (text == "transparent") {
        return Backdrop{};
    }
    if (const std::string_view digits = named_digits(text); !digits.empty()) {
        return Backdrop{.color = parse_hexadecimal(digits)};
    }
    const std::size_t sign = text.starts_with('#') ? 1 : text.starts_with("0x") ? 2 : 0;
    const std::optional<io::SrgbColor> color =
        text.find(',') != std::string::npos
            ? parse_parts(text)
            : parse_hexadecimal(std::string_view(text).substr(sign));
    if (color) {
        return Backdrop{.color = color};
    }
    return find_type(given) ? std::optional(Backdrop{.color = {}, .photo = given}) : std::nullopt;
}

std::string backdrop_text(const Backdrop& backdrop)
{
    if (!backdrop.photo.empty()) {
        return backdrop.photo.string();
    }
    return backdrop.color ? fmt::format("#{:02x}{:02x}{:02x}", (*backdrop.color)[0],
                                        (*backdrop.color)[1], (*backdrop.color)[2])
                          : "transparent";
}

void check_transparency(const DisplayArguments& display,
                        std::span<const std::filesystem::path> outputs)
{
    for (const std::filesystem::path& output : outputs) {
        if (display.backdrop && display.backdrop->is_transparent() &&
            find_type(output) == ImageType::jpeg) {
            throw OptionError(fmt::format(
                "{}: JPEG has no alpha for --background transparent: name it .png or .webp",
                output.string()));
        }
    }
}

void add_display_options(OptionList& options, DisplayArguments& display)
{
    Option& exposure = options.add(
        "--exposure", "EV|auto|light",
        "Exposure of .png, .jpg and .webp: pixels times 2^EV, metered from the image (auto), or "
        "from the incident light, so that a white card appears white (light); auto+1 or light-0.5 "
        "adds an offset, +1 alone is 1 EV. Default: light with --background, --orbit and --frames, "
        "and of objects seen from outside under an environment; else auto",
        display.exposure,
        parsed_by(parse_exposure,
                  "EV from -100 to 100, auto or light, or one of these plus or minus EV, like "
                  "light-0.5"));
    exposure.info.may_be_number = true;
    exposure.uses.plan_render = true;    // the light is metered where the scene is
    exposure.uses.python_render = true;  // likewise
    const auto curves = make_choices(io::all_tone_curves, io::tone_curve_name);
    add_choice(options, "--tone-map",
               "Tone mapping of .png, .jpg and .webp: filmic (default), pbr-neutral (keeps base "
               "colours under "
               "grey light, best with --exposure), agx, or none (clamps)",
               display.curve, curves);
    Option& background = options.add(
        "--background", "transparent|black|white|#RRGGBB|FILE",
        "Replace the environment where the camera sees it directly; it still lights the scene. "
        ".exr gets alpha (premultiplied colours); .png and .webp get alpha (transparent), this "
        "sRGB colour (or red, grey, ...), or a photograph (.png, .jpg, "
        ".webp, .exr, .hdr) that fills the frame",
        display.backdrop,
        parsed_by(
            parse_backdrop,
            "transparent, a colour like white, #f0f0f0, #fff or 0.9,0.9,0.9, or the name of a "
            ".png, .jpg, .webp, .exr or .hdr file"));
    background.info.separator = ',';
    background.uses.plan_render = true;    // its alpha is needed for merging
    background.uses.python_render = true;  // and for save()
    const Choices<TexelType> depths{{{"8", TexelType::unorm8}, {"16", TexelType::unorm16}}};
    options.add("--png-bits", "8|16", "Bits per channel of .png: 8 (default) or 16", display.type,
                depths.type());
}

void add_denoise_options(OptionList& options, DenoiseArguments& denoise)
{
    const Choices<Denoising> kinds{{{"auto", Denoising::automatic},
                                    {"image", Denoising::image},
                                    {"layer", Denoising::layer},
                                    {"true", Denoising::image},  // without a value
                                    {"false", Denoising::none}}};
    Option& flag = options.add_flag(
        "--denoise",
        "Denoise the image with Open Image Denoise 2, guided by albedo and normal; .exr keeps the "
        "noisy image as layer \"noisy\". With --denoise=layer .exr stays noisy and gets the layer "
        "\"denoised\". Default: auto, which denoises .png, .jpg and .webp if the library is found, "
        "and never .exr and .hdr; --denoise=false denoises nothing",
        denoise.kind,
        ValueType<Denoising>{.parse = kinds.type().parse,
                             .expected = "auto, image, layer, true or false",
                             .info = kinds.type().info});
    flag.uses.plan_render = true;  // its layers are needed for merging
    flag.default_is_chosen = true;
    Option& library =
        options.add("--denoiser-library", "FILE|DIR",
                    "Open Image Denoise 2: the library or its folder. Default: BDPT_DENOISER in "
                    "the environment, else the library that comes with bdpt, else the system's "
                    "libOpenImageDenoise.so.2",
                    denoise.library, some_text("a file or a folder"));
    library.uses = {.python_save = true, .stated_in = StatedIn::programs};  // it is code
}

bool needs_denoiser(const DenoiseArguments& asked, std::span<const std::filesystem::path> outputs)
{
    return asked.kind == Denoising::automatic
               ? std::any_of(outputs.begin(), outputs.end(), is_for_screens)
               : asked.is_asked() && !outputs.empty();
}

std::vector<Aov> missing_guides(const AovSet& known, const std::optional<Backdrop>& backdrop)
{
    std::vector<Aov> guides{Aov::albedo, Aov::normal};
    if (backdrop) {
        guides.push_back(Aov::opacity);
    }
    std::erase_if(guides, [&known](Aov aov) { return known.contains(aov); });
    return guides;
}

}  // namespace bdpt::job
