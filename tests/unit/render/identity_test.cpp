#include <bdpt/options/option_fields.h>
#include <bdpt/part/identity.h>

#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>
#include <bdpt/scene.h>

#include "catch.hpp"
#include "identity/scene_identity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

// Every field of the options and descriptions is changed by itself. A new field is found by the
// lists of fields, which the compiler keeps complete; its name is then in `without_influence`, or
// the identity must change with it.

namespace bdpt::test::identity_test {
namespace {

RenderOptions options()
{
    RenderOptions result;
    result.integrator = IntegratorKind::bdpt;
    result.film.width = 19;
    result.film.height = 14;
    result.sampling.samples = {.begin = 0, .end = 16};
    return result;
}

// Another value that is valid, too, for each type that options and cameras have.

template <std::integral T>
void change(T& value)
{
    value = value > 1 ? value - 1 : value + 1;
}
template <std::floating_point T>
void change(T& value)
{
    value = std::isfinite(value) ? value / 2 + T(0.125) : T(20);
}
template <typename T>
requires std::is_enum_v<T>
void change(T& value)
{
    const int number = static_cast<int>(value);
    value = static_cast<T>(number > 0 ? number - 1 : 1);
}
void change(IntegratorKind& value)
{
    value = IntegratorKind::pt;
}
void change(SampleRange& value)
{
    value.end += SampleRates::group;
}
void change(AovSet& value)
{
    value.insert(Aov::albedo);
}
void change(Vec2& value)
{
    value.x += 1.0f;
}
void change(Mat4& value)
{
    value[3].x += 1.0f;
}
void change(std::string& value)
{
    value += "x";
}
void change(std::vector<Strategy>& value)
{
    value.push_back({.s = 1, .t = 2});
}
void change(std::vector<Mat4>& value)
{
    value.emplace_back(1.0f);
}
void change(std::optional<PixelRect>& value)
{
    value = PixelRect{.x0 = 2, .y0 = 3, .x1 = 9, .y1 = 8};
}
template <std::floating_point T>
void change(std::optional<T>& value)
{
    value = T(0.5);
}
void change(std::shared_ptr<const SampleRates>& value)
{
    const RenderOptions o = options();
    value = std::make_shared<SampleRates>(
        o.film.width, o.film.height,
        std::vector<std::int8_t>(static_cast<std::size_t>(o.film.width * o.film.height)));
}

/// Calls `check(name)` once for each number, text, ... in `value` while that has another value.
template <typename T>
void with_each_change(const std::string& name, T& value,
                      const std::function<void(const std::string&)>& check)
{
    if constexpr (std::is_same_v<T, SystemOptions>) {
        auto& [tile_size, threads] = value;  // does not compile if it has more
        with_each_change("tile_size", tile_size, check);
        with_each_change("threads", threads, check);
    } else if constexpr (HasFields<T>) {
        for_each_field(value, [&](const auto& field, auto& member) {
            constexpr bool is_part_of_value = std::is_same_v<T, FilterOptions>;
            with_each_change(is_part_of_value ? name : std::string(field.name), member, check);
        });
    } else {
        const T before = value;
        change(value);
        check(name);
        value = before;
    }
}

/// Names of the components in which the identities differ.
std::set<std::string> changed_components(const Identity& a, const Identity& b)
{
    std::set<std::string> names;
    for (const auto& [here, there] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        for (const IdentityComponent& component : here->components) {
            if (std::find(there->components.begin(), there->components.end(), component) ==
                there->components.end()) {
                names.insert(component.name);
            }
        }
    }
    return names;
}

TEST_CASE("each option changes the identity by itself, but for those that change no bit", "[part]")
{
    const std::set<std::string> without_influence{"samples",           "planned_samples",
                                                  "light_path_memory", "strategy_memory",
                                                  "tile_size",         "threads"};
    const Scene scene{SceneDesc{}};
    RenderOptions o = options();
    const Identity before = identity(scene, CameraDesc{}, o);
    std::set<std::string> seen;
    with_each_change("", o, [&](const std::string& name) {
        CAPTURE(name);
        // Two options of one name were one component; a filter is one option of two numbers.
        CHECK((seen.insert(name).second || name == "filter"));
        const std::set<std::string> changed =
            changed_components(before, identity(scene, CameraDesc{}, o));
        CHECK(changed == (without_influence.contains(name)
                              ? std::set<std::string>{}
                              : std::set<std::string>{"option: " + name}));
    });
    CHECK(std::includes(seen.begin(), seen.end(), without_influence.begin(),
                        without_influence.end()));
}

TEST_CASE("each number of an option's value belongs to the identity", "[part]")
{
    const Scene scene{SceneDesc{}};
    RenderOptions o = options();
    change(o.film.crop);
    change(o.bidirectional.disabled);
    const auto check = [&, before = identity(scene, CameraDesc{}, o)](const std::string& name) {
        CAPTURE(name);
        CHECK(identity(scene, CameraDesc{}, o) != before);
    };
    with_each_change("", *o.film.crop, check);
    with_each_change("", o.bidirectional.disabled.front(), check);

    change(o.sampling.rates);
    const Identity with_rates = identity(scene, CameraDesc{}, o);
    std::vector<std::int8_t> exponents = o.sampling.rates->exponents();
    exponents.back() = 1;
    o.sampling.rates = std::make_shared<SampleRates>(o.film.width, o.film.height, exponents);
    CHECK(identity(scene, CameraDesc{}, o) != with_rates);
}

TEST_CASE("each property of a camera changes the identity, but for its name and shape", "[part]")
{
    const std::set<std::string> without_influence{"name", "aspect ratio"};
    const Scene scene{SceneDesc{}};
    CameraDesc camera;
    const Identity before = identity(scene, camera, options());
    with_each_change("", camera, [&](const std::string& name) {
        CAPTURE(name);
        CHECK(changed_components(before, identity(scene, camera, options())) ==
              (without_influence.contains(name) ? std::set<std::string>{}
                                                : std::set<std::string>{"camera: " + name}));
    });
}

// Descriptions of scenes need not be valid to be hashed: each byte of them counts.

using Check = std::function<void(const std::string& name, bool counts)>;

// Call `check` while one byte or one length in `value` is another; `counts` tells whether an image
// can show that.
template <typename T>
void with_each_byte_changed(const std::string& name, T& value, const Check& check);
template <typename T>
void with_each_byte_changed(const std::string& name, std::vector<T>& list, const Check& check);
template <typename T>
void with_each_byte_changed(const std::string& name, std::optional<T>& value, const Check& check);
template <typename T, std::size_t n>
void with_each_byte_changed(const std::string& name, std::array<T, n>& list, const Check& check);
template <typename... Kinds>
void with_each_byte_changed(const std::string& name, std::variant<Kinds...>& value,
                            const Check& check);

template <typename T>
void with_each_byte_changed(const std::string& name, std::vector<T>& list, const Check& check)
{
    list.emplace_back();
    check(name + ": size", true);
    with_each_byte_changed(name + "[0]", list.back(), check);
    list.pop_back();
}

template <typename T>
void with_each_byte_changed(const std::string& name, std::optional<T>& value, const Check& check)
{
    value.emplace();
    check(name + ": is there", true);
    with_each_byte_changed(name, *value, check);
    value.reset();
}

template <typename T, std::size_t n>
void with_each_byte_changed(const std::string& name, std::array<T, n>& list, const Check& check)
{
    for (std::size_t i = 0; i < n; ++i) {
        with_each_byte_changed(name + "[" + std::to_string(i) + "]", list[i], check);
    }
}

template <typename... Kinds>
void with_each_byte_changed(const std::string& name, std::variant<Kinds...>& value,
                            const Check& check)
{
    const auto before = value;
    const auto with_kind = [&]<typename Kind>(const Kind& kind) {
        value = kind;
        if (value.index() != before.index()) {
            check(name + ": kind", true);
        }
        with_each_byte_changed(name, std::get<Kind>(value), check);
    };
    (with_kind(Kinds{}), ...);
    value = before;
}

template <typename T>
void with_each_byte_changed(const std::string& name, T& value, const Check& check)
{
    if constexpr (std::is_same_v<T, std::string>) {
        value = "name";
        check(name, false);
        value.clear();
    } else if constexpr (std::is_same_v<T, Image>) {
        auto& [width, height, pixels] = value;
        with_each_byte_changed(name + ": width", width, check);
        with_each_byte_changed(name + ": height", height, check);
        with_each_byte_changed(name + ": pixels", pixels, check);
    } else if constexpr (std::is_same_v<T, EnvironmentImage>) {
        Image image;
        const Check of_image = [&](const std::string& what, bool changes) {
            value = image;
            check(what, changes);
        };
        with_each_byte_changed(name, image, of_image);
        value = {};
    } else if constexpr (std::is_same_v<T, TexelImage>) {
        auto& [width, height, bytes, channels, type] = value;
        with_each_byte_changed(name + ": width", width, check);
        with_each_byte_changed(name + ": height", height, check);
        with_each_byte_changed(name + ": channels", channels, check);
        with_each_byte_changed(name + ": type", type, check);
        with_each_byte_changed(name + ": bytes", bytes, check);
    } else if constexpr (HasFields<T>) {
        for_each_field(value, [&](const auto& field, auto& member) {
            with_each_byte_changed(name + ": " + std::string(field.name), member, check);
        });
    } else {
        static_assert(PlainValue<T>);
        const T before = value;
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            reinterpret_cast<unsigned char*>(&value)[i] ^= 1U;
            check(name, true);
            value = before;
        }
    }
}

TEST_CASE("each byte of a scene changes the identity, but for names", "[part]")
{
    SceneDesc scene;
    std::size_t count = 0;
    std::set<std::vector<std::string>> known;  // identities of all scenes so far
    const auto text = [&] {
        std::vector<std::string> result;
        for (const IdentityComponent& component : identity_components(scene)) {
            result.push_back(component.name + " " + component.value);
        }
        return result;
    };
    known.insert(text());
    with_each_byte_changed("scene", scene, [&](const std::string& name, bool counts) {
        CAPTURE(name);
        CHECK(known.insert(text()).second == counts);
        ++count;
    });
    CHECK(count > 1000);
}

TEST_CASE("builds of other versions and instruction sets are told apart", "[part]")
{
    std::string names;
    for (const auto& [name, value] :
         identity(Scene{SceneDesc{}}, CameraDesc{}, options()).components) {
        names += name + "\n";
    }
    for (const char* name : {"build: instruction set", "build: Embree", "build: version"}) {
        CAPTURE(name);
        CHECK(names.find(name) != std::string::npos);
    }
}

}  // namespace
}  // namespace bdpt::test::identity_test
