#include "options/option_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "options/value_types.h"

namespace bdpt::job {
namespace {

/// Returns the number of insertions, deletions and replacements that turn `a` into `b` [Levenshtein
/// 1966].
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

/// Accepts the booleans of shells and configuration files.
ValueType<bool> yes_or_no()
{
    const auto parse = [](const std::string& given) -> std::optional<bool> {
        const std::string text = lower_case(given);
        if (text == "true" || text == "1" || text == "yes" || text == "on") {
            return true;
        }
        if (text == "false" || text == "0" || text == "no" || text == "off") {
            return false;
        }
        return std::nullopt;
    };
    return {.parse = parse, .expected = "no value, or true or false", .info = {}};
}

/// Returns ": WHY", or nothing.
std::string reason(std::string_view why)
{
    return why.empty() ? "" : fmt::format(": {}", why);
}

/// Options of Blender, Mitsuba, pbrt, model-viewer, ffmpeg, ImageMagick and others that mean the
/// same as one of ours.
struct Foreign {
    std::string_view words;  ///< " --width --height "; a space around each
    ForeignOption meant;
};

constexpr std::array<Foreign, 43> foreign_options{{
    {" --width --height --resolution --res --dimensions --image-size --resize --geometry -s -w -W "
     "-H ",
     {"--size", "use --size WIDTHxHEIGHT"}},
    {" --samples-per-pixel --sample-count --num-samples --iterations -n ",
     {"--spp", "use --spp N"}},
    {" --port --host --bind --address -p ", {"--listen", "use --listen 127.0.0.1:PORT"}},
    {" --browser --launch ", {"--open", "use --open"}},
    {" --format --render-format --type --extension -F ",
     {"--output", "the name of the file says it, as in -o NAME.jpg"}},
    {" --out --outfile --output-file --render-output --save ", {"--output", "use -o FILE"}},
    {" --input --infile --in --background-mode -i -b ",
     {"file", "the scene is named without an option, as in bdpt render scene.glb"}},
    {" --overwrite --force -y -f ", {"--output", "existing images are replaced without asking"}},
    {" --gpu --cuda --optix --device --backend --cycles-device --wavefront ",
     {"--threads", "bdpt renders on the processor; --threads N limits its threads"}},
    {" --nthreads --num-threads --cpus --cores --jobs -t -j ", {"--threads", "use --threads N"}},
    {" --engine --renderer --render-engine --method --mode -E -m ",
     {"--integrator", "use --integrator NAME"}},
    {" --frame --render-frame --frame-start --frame-end ",
     {"--frames", "use --frames BEGIN:END, or --frame-time SECONDS for one image"}},
    {" --render-anim --anim --animate -a ", {"--frames", "use --frames BEGIN:END --fps N"}},
    {" --framerate --frame-rate -r ", {"--fps", "use --fps N"}},
    {" --turntable --spin --auto-rotate --rotate ", {"--orbit", "use --orbit N -o NAME.###.png"}},
    {" --camera-orbit --camera-position --eye --origin --position ",
     {"--from", "use --from X,Y,Z and --look-at X,Y,Z, or --view"}},
    {" --target --camera-target --lookat --at ", {"--look-at", "use --look-at X,Y,Z"}},
    {" --field-of-view --camera-fov --angle ", {"--fov", "use --fov DEGREES"}},
    {" --environment --environment-image --envmap --env-map --hdri --skybox --skybox-image --ibl "
     "--sky --world ",
     {"--env", "use --env FILE, default, studio or none"}},
    {" --tonemap --tone-mapping --tonemapping --view-transform --look --curve ",
     {"--tone-map", "use --tone-map NAME"}},
    {" --gamma --brightness --ev --gain ", {"--exposure", "use --exposure EV"}},
    {" --bg --bg-color --background-color --backdrop ",
     {"--background", "use --background COLOUR, FILE or transparent"}},
    {" --alpha --transparent --film-transparent ",
     {"--background", "use --background transparent"}},
    {" --shadow --shadows --shadow-intensity --shadow-catcher --floor ",
     {"--ground", "use --ground shadow"}},
    {" --quality --noise-threshold --adaptive-threshold ",
     {"--noise", "use --noise N%, --spp N or --time TIME"}},
    {" --time-limit --timeout --max-time --duration ", {"--time", "use --time TIME"}},
    {" --bounces --max-bounces --maxdepth --depth --max-path-length ",
     {"--max-depth", "use --max-depth N, the edges of a path"}},
    {" --region --crop-window --cropwindow --border --rect ", {"--crop", "use --crop X0,Y0,X1,Y1"}},
    {" --passes --layers --aovs --render-passes --channels ", {"--aov", "use --aov NAMES"}},
    {" --denoiser --oidn --clean ", {"--denoise", "use --denoise"}},
    {" --bits --bit-depth --bpp ", {"--png-bits", "use --png-bits 16, or an .exr file"}},
    {" --aperture --fstop --f-number --dof ", {"--f-stop", "use --f-stop N"}},
    {" --focus --focal-distance --focus-dist ",
     {"--focus-distance", "use --focus-distance METRES"}},
    {" --checkpoint --resume --continue ", {"--part", "use --part FILE"}},
    {" --loglevel --log-level --silent --no-progress ", {"--quiet", "use --quiet, or --verbose"}},
    {" --profile --profiling ", {"--stats", "use --stats FILE, or a profiler such as perf"}},
    {" --debug --info --progress ", {"--verbose", "use --verbose"}},
    {" --var --define -D ", {"", "options have names of their own, as in --spp 64"}},
    {" --interactive --preview --gui --window ",
     {"--integrator", "bdpt view SCENE shows a scene while it renders"}},
    {" --usage --manual -? ", {"", "use --help"}},
    {" --metric -metric ", {"--metrics", "use --metrics NAMES"}},
    {" --diff --difference ", {"--error-image", "use --error-image FILE"}},
    {" -v -V --Version ", {"", "use --version"}},
}};

/// Values of other renderers and image tools, and those of ours that come nearest.
struct ForeignValue {
    std::string_view option;
    std::string_view words;  ///< in lower case, with a space around each
    std::string_view ours;
};

constexpr std::array<ForeignValue, 24> foreign_values{{
    {"--size", " hd 720p ", "1280x720"},
    {"--size", " fullhd fhd 1080p ", "1920x1080"},
    {"--size", " qhd 1440p ", "2560x1440"},
    {"--size", " uhd 4k 2160p ", "3840x2160"},
    {"--tone-map", " aces hable reinhard uncharted ", "filmic"},
    {"--tone-map", " neutral commerce khronos pbr ", "pbr-neutral"},
    {"--tone-map", " linear standard raw srgb off clamp ", "none"},
    {"--integrator", " path pathtracer path-tracing volpath unidirectional cycles ", "mis"},
    {"--integrator", " direct directlighting ", "nee"},
    {"--integrator", " ptracer particle lighttracer lightpath ", "lt"},
    {"--integrator", " bidirectional bidir ", "bdpt"},
    {"--integrator", " sppm photonmapper upbp ", "vcm"},
    {"--integrator", " default best ", "auto"},
    {"--sampler", " halton zsobol paddedsobol ldsampler stratified ", "sobol"},
    {"--sampler", " random ", "independent"},
    {"--filter", " triangle ", "tent"},
    {"--filter", " gauss ", "gaussian"},
    {"--filter", " mitchell lanczos sinc blackman blackmanharris ", "blackman-harris"},
    {"--background", " none alpha clear ", "transparent"},
    {"--ground", " shadows catcher floor plane true on ", "shadow"},
    {"--ground", " false off ", "none"},
    {"--aov", " normals ", "normal"},
    {"--aov", " z ", "depth"},
    {"--aov", " diffuse basecolor color ", "albedo"},
}};

/// Returns the value of ours that comes nearest to the invalid `text`, in lower case, which people
/// give for `option`: "filmic" for "aces". None: not known.
std::optional<std::string_view> value_for(std::string_view option, std::string_view text)
{
    const std::string wanted = fmt::format(" {} ", text);
    for (const ForeignValue& foreign : foreign_values) {
        if (foreign.option == option && foreign.words.find(wanted) != std::string_view::npos) {
            return foreign.ours;
        }
    }
    return std::nullopt;
}

}  // namespace

void reject(std::string_view option, std::string_view value, std::string_view expected)
{
    throw OptionError(fmt::format("{} \"{}\": expected {}", option, value, expected));
}

std::string Option::name() const
{
    const std::size_t comma = names.find(',');
    return comma == std::string::npos ? names : names.substr(comma + 1);
}

std::string Option::word() const
{
    const std::string& text = texts.back();
    return is_flag() && text == "true" ? name() : name() + "=" + text;
}

std::string Option::spelled(std::string text) const
{
    if (info.respelled) {
        text = info.respelled(std::move(text));
    }
    const auto word = std::find_if(info.words.begin(), info.words.end(),
                                   [small = lower_case(text)](const std::string& known) {
                                       return lower_case(known) == small;
                                   });
    return word != info.words.end() ? *word : text;
}

std::optional<std::string> Option::meant(const std::string& text) const
{
    const std::string small = lower_case(text);
    const std::optional<std::string_view> known = value_for(name(), small);
    return known ? std::string(*known) : closest(small, info.words);
}

void OptionList::section(std::string title, OptionUses uses)
{
    section_ = std::move(title);
    uses_ = uses;
}

Option& OptionList::append(std::string names, std::string value, std::string help)
{
    Option& option = options_.emplace_back();
    option.names = std::move(names);
    option.value = std::move(value);
    option.help = std::move(help);
    option.section = section_;
    option.uses = uses_;
    return option;
}

Option& OptionList::add_flag(std::string names, std::string help, bool& target)
{
    return add_flag(std::move(names), std::move(help), target, yes_or_no());
}

const Option* OptionList::find(std::string_view name) const
{
    const auto found = std::find_if(options_.begin(), options_.end(),
                                    [name](const Option& option) { return option.name() == name; });
    return found != options_.end() ? &*found : nullptr;
}

const Option& OptionList::at(std::string_view name) const
{
    const Option* option = find(name);
    if (option == nullptr) {
        throw std::logic_error(fmt::format("there is no option {}", name));
    }
    return *option;
}

bool OptionList::given(std::string_view name) const
{
    const Option* option = find(name);
    return option != nullptr && option->given();
}

void OptionList::reject_value(std::string_view name, std::string_view expected) const
{
    reject(name, at(name).texts.back(), expected);
}

void OptionList::take_texts(const OptionList& other)
{
    for (Option& option : options_) {
        if (const Option* same = other.find(option.name())) {
            option.texts = same->texts;
        }
    }
}

void OptionList::store_given()
{
    for (Option& option : options_) {
        const std::vector<std::string> typed = option.texts;
        for (std::string& text : option.texts) {
            text = option.spelled(std::move(text));
        }
        if (option.repeats) {
            option.clear();
        }
        // All texts of a repeatable option, else only the last one.
        const std::size_t first = option.repeats || !option.given() ? 0 : option.texts.size() - 1;
        for (std::size_t i = first; i < option.texts.size(); ++i) {
            if (!option.store(option.texts[i])) {
                const std::optional<std::string> meant = option.meant(typed[i]);
                reject(option.name(), typed[i],
                       option.expected + (meant ? fmt::format(" (did you mean {}?)", *meant) : ""));
            }
        }
    }
}

void check(std::span<const Need> needs, const OptionList& options)
{
    for (const Need& need : needs) {
        if (!options.given(need.option)) {
            continue;
        }
        const std::vector<std::string_view> others = split(need.other, '|');
        if (std::none_of(others.begin(), others.end(),
                         [&](std::string_view other) { return options.given(other); })) {
            throw OptionError(fmt::format("{} needs {}{}", need.option,
                                          words_text({others.begin(), others.end()}),
                                          reason(need.why)));
        }
    }
}

void check(std::span<const Conflict> conflicts, const OptionList& options)
{
    for (const Conflict& conflict : conflicts) {
        if (options.given(conflict.option) && options.given(conflict.other)) {
            throw OptionError(fmt::format("{} cannot be combined with {}{}", conflict.option,
                                          conflict.other, reason(conflict.why)));
        }
    }
}

std::optional<ForeignOption> find_foreign(std::string_view name, const OptionList& options)
{
    const std::string wanted = " " + std::string(name) + " ";
    for (const Foreign& foreign : foreign_options) {
        if (foreign.words.find(wanted) != std::string_view::npos &&
            (foreign.meant.option.empty() || options.find(foreign.meant.option) != nullptr)) {
            return foreign.meant;
        }
    }
    return std::nullopt;
}

std::optional<std::string> closest(std::string_view text, std::span<const std::string> words)
{
    // With half of its letters wrong it is another word.
    std::size_t best = text.size() / 2;
    std::optional<std::string> result;
    for (const std::string& word : words) {
        const std::size_t distance = edit_distance(text, word);
        if (distance < best) {
            best = distance;
            result = word;
        }
    }
    return result;
}

}  // namespace bdpt::job
