#include "scene/checks/validate.h"

#include <bdpt/error.h>
#include <bdpt/scene_desc.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace bdpt::fields_test {
namespace {

// A list that has not all members, or one of them at another's place, does not compile.
struct Sample {
    int count = 0;
    float size = 0.0f;
    std::optional<TextureRef> texture;
};
static_assert(HasMoreThan<Sample, int, float>);
static_assert(!HasMoreThan<Sample, int, float, std::optional<TextureRef>>);
static_assert(BeginsWith<Sample, int, float, std::optional<TextureRef>>);
static_assert(!BeginsWith<Sample, int, std::optional<TextureRef>>);
static_assert(detail::count_pairs(&Sample::count, &Sample::size) == 2);
static_assert(detail::count_pairs(&Sample::count, &Sample::count) == 4);

static_assert(HasFields<MaterialDesc> && HasFields<const CameraDesc&> && !HasFields<Sample>);

/// Calls `visit(name, number)` with each number of a material and of its layers.
template <typename Desc, typename Visitor>
void for_each_number(Desc& desc, const Visitor& visit)
{
    for_each_field(desc, [&visit](const auto& field, auto& value) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<T, float>) {
            visit(field.name, value);
        } else if constexpr (std::is_same_v<T, Rgb> || std::is_same_v<T, Vec4>) {
            for (int c = 0; c < T::length(); ++c) {
                visit(field.name, value[c]);
            }
        } else if constexpr (HasFields<T>) {
            for_each_number(value, visit);
        }
    });
}

}  // namespace

TEST_CASE("each number of a material is refused when it is none", "[fields]")
{
    test::SceneBuilder builder;
    builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, test::lambertian(Rgb(0.5f)));
    SceneDesc& desc = builder.desc;
    CHECK_NOTHROW(validate(desc));
    int numbers = 0;
    for_each_number(desc.materials[0], [&](std::string_view name, float& number) {
        ++numbers;
        const float before = number;
        number = std::numeric_limits<float>::quiet_NaN();
        CAPTURE(name);
        try {
            validate(desc);
            FAIL_CHECK("accepted");
        } catch (const Error& error) {
            CHECK(std::string(error.what()).find(std::string(name) + " is nan") !=
                  std::string::npos);
        }
        number = before;
    });
    CHECK(numbers == 60);
}

TEST_CASE("each texture of a material is checked", "[fields]")
{
    test::SceneBuilder builder;
    builder.quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, test::lambertian(Rgb(0.5f)));
    std::set<const void*> slots;
    for_each_texture(builder.desc.materials[0], [&](std::optional<TextureRef>& slot) {
        slots.insert(&slot);
        slot = TextureRef{.image = ImageId{7}};
        CHECK_THROWS_AS(validate(builder.desc), Error);
        slot.reset();
    });
    CHECK(slots.size() == 27);
}

}  // namespace bdpt::fields_test
