#include "equality_cases.h"

#include "scene_builder.h"

#include <utility>

namespace bdpt::test {
namespace {

const Rgb white(0.7f);
const Rgb red(0.6f, 0.1f, 0.1f);
const Rgb green(0.15f, 0.5f, 0.15f);

SceneBuilder room(const MaterialDesc& floor = lambertian(white),
                  const MaterialDesc& walls = lambertian({0.7f, 0.5f, 0.3f}))
{
    SceneBuilder builder;
    builder.walls(floor, walls);
    return builder;
}

SceneBuilder lit_room(const MaterialDesc& floor = lambertian(white))
{
    SceneBuilder builder = room(floor);
    builder.ceiling(lambertian(white)).lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    return builder;
}

EqualityCase in_room(std::string name, SceneBuilder builder, std::optional<int> seen_by_lt = 1)
{
    return {.name = std::move(name),
            .scene = std::move(builder.desc),
            .camera = room_camera(),
            .seen_by_lt = seen_by_lt};
}

Image gradient_sky()
{
    Image sky{.width = 16, .height = 8, .pixels = {}};
    for (int y = 0; y < sky.height; ++y) {
        for (int x = 0; x < sky.width; ++x) {
            const float sun = x == 5 && y == 1 ? 12.0f : 0.0f;
            sky.pixels.emplace_back(1.5f - 0.15f * static_cast<float>(y) + sun,
                                    0.5f + 0.05f * static_cast<float>(x) + sun, 1.0f + sun);
        }
    }
    return sky;
}

/// A coarse sphere whose smooth normals differ a lot from its facets.
EqualityCase shading_normals()
{
    SceneBuilder builder = lit_room();
    builder.sphere({-0.4f, -0.5f, 0.0f}, 0.45f, lambertian(white), 8);
    builder.sphere({0.5f, -0.5f, 0.1f}, 0.45f, plastic(red, 0.4f), 6);
    return in_room("shading normals", std::move(builder));
}

/// Shared geometry, turned, stretched and mirrored, with a mirrored one-sided emitter.
EqualityCase mirrored_instances()
{
    SceneBuilder builder = room();
    const MeshId ball = builder.sphere_mesh(24);
    const auto at = [](float x, float y, float z) {
        return glm::translate(Mat4(1.0f), Vec3(x, y, z));
    };
    builder.place(ball, lambertian(red),
                  glm::scale(at(-0.6f, -0.6f, 0.0f), Vec3(-0.3f, 0.4f, 0.3f)));
    builder.place(ball, plastic(green, 0.3f),
                  glm::rotate(glm::scale(at(0.5f, -0.5f, -0.2f), Vec3(0.3f, 0.5f, 0.2f)), 0.6f,
                              Vec3(0.0f, 0.0f, 1.0f)));
    builder.place(ball, glass(0.0f), glm::scale(at(0.0f, 0.1f, 0.3f), Vec3(0.25f, -0.25f, 0.25f)));
    MeshDesc plate;
    plate.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
    plate.triangles = {{0, 1, 2}, {0, 2, 3}};  // the front looks down
    const MeshId mesh = builder.add_mesh(std::move(plate));
    builder.place(mesh, emitter(Rgb(3.0f)),
                  glm::scale(at(0.0f, 0.9f, -0.4f), Vec3(0.6f, 1.0f, 0.4f)));
    builder.place(mesh, emitter({3.0f, 2.0f, 1.0f}),
                  glm::scale(at(0.0f, 0.9f, 0.5f), Vec3(-0.6f, 1.0f, 0.4f)));
    return in_room("instances with negative scale", std::move(builder), std::nullopt);
}

/// All texture slots at once, with a transform, vertex colours and a normal map.
EqualityCase textures()
{
    SceneBuilder builder = lit_room();
    TexelImage pattern{.width = 4, .height = 4, .bytes = {}};
    for (int i = 0; i < 16; ++i) {
        const auto value = static_cast<std::uint8_t>(i % 3 == 0 ? 230 : 90 + 8 * i);
        const auto inverse = static_cast<std::uint8_t>(255 - value);
        pattern.bytes.insert(pattern.bytes.end(), {value, inverse, 128, 255});
    }
    builder.desc.images.push_back(pattern);
    TexelImage bumps{
        .width = 2,
        .height = 2,
        .bytes = {150, 128, 250, 255, 128, 150, 250, 255, 106, 128, 250, 255, 128, 106, 250, 255}};
    builder.desc.images.push_back(bumps);
    MaterialDesc material = plastic(white, 0.8f);
    material.base_color_texture =
        TextureRef{.image = ImageId{0}, .rotation = 0.3f, .scale = {3, 2}};
    material.metallic = 0.5f;
    material.metallic_roughness_texture = TextureRef{.image = ImageId{0}, .scale = {2, 2}};
    material.normal_texture = TextureRef{.image = ImageId{1}, .scale = {4, 4}};
    builder.sphere({0.0f, -0.4f, 0.0f}, 0.55f, material);
    MaterialDesc screen = emitter(Rgb(2.0f));
    screen.emission_texture = TextureRef{.image = ImageId{0}, .wrap_u = Wrap::mirrored_repeat};
    builder.quad({-0.5f, 0.2f, -0.95f}, {0.5f, 0.2f, -0.95f}, {0.5f, 0.8f, -0.95f},
                 {-0.5f, 0.8f, -0.95f}, screen);
    auto& colors = builder.desc.meshes.front().colors;
    colors = {{1, 1, 1, 1}, {1, 0.2f, 0.2f, 1}, {0.2f, 1, 0.2f, 1}, {0.2f, 0.2f, 1, 1}};
    return in_room("textures, normal map, vertex colours", std::move(builder));
}

/// The same room at another size and place: offsets and densities must follow.
EqualityCase scaled(std::string name, float scale, Vec3 shift)
{
    SceneBuilder builder = lit_room();
    builder.sphere({-0.4f, -0.5f, 0.0f}, 0.4f, glass(0.0f));
    builder.sphere({0.5f, -0.6f, 0.2f}, 0.4f, lambertian(red));
    EqualityCase result = in_room(std::move(name), std::move(builder), std::nullopt);
    const Mat4 transform = glm::scale(glm::translate(Mat4(1.0f), shift), Vec3(scale));
    for (InstanceDesc& instance : result.scene.instances) {
        instance.world_from_object = transform * instance.world_from_object;
    }
    result.camera.world_from_camera = transform * result.camera.world_from_camera;
    return result;
}

/// Most of this sky is below half of its mean, so light sampling leaves it to BSDF sampling.
EqualityCase sunny_sky()
{
    Image sky{.width = 16, .height = 8, .pixels = std::vector<Rgb>(128, Rgb(0.4f, 0.5f, 0.7f))};
    for (const std::size_t texel : {18U, 19U, 34U, 35U}) {  // two by two
        sky.pixels[texel] = Rgb(40.0f, 35.0f, 25.0f);
    }
    SceneBuilder room_with_sphere = room();
    room_with_sphere.sphere({0.4f, -0.6f, 0.0f}, 0.4f, plastic(white, 0.3f));
    room_with_sphere.light(EnvironmentLightDesc{.radiance = std::move(sky)});
    return in_room("environment with a sun", std::move(room_with_sphere), 2);
}

void add_lights(std::vector<EqualityCase>& cases)
{
    cases.push_back(in_room("area light", lit_room()));
    SceneBuilder hidden = room();
    hidden.ceiling(lambertian(white));
    hidden.quad({-0.8f, 0.3f, 0.6f}, {0.8f, 0.3f, 0.6f}, {0.8f, 0.3f, -0.6f}, {-0.8f, 0.3f, -0.6f},
                emitter(Rgb(6.0f)));
    cases.push_back(in_room("hidden light", std::move(hidden)));
    cases.back().detectable_bias_of_light_sampling = 0.05;  // few camera paths get to see it

    SceneBuilder two_sided = room();
    MaterialDesc both = emitter(Rgb(3.0f, 2.0f, 1.0f));
    both.double_sided = true;
    two_sided.ceiling(lambertian(white));
    two_sided.quad({-0.5f, -0.3f, 0.1f}, {0.5f, -0.3f, 0.1f}, {0.5f, 0.4f, -0.3f},
                   {-0.5f, 0.4f, -0.3f}, both);
    cases.push_back(in_room("two-sided emitter", std::move(two_sided)));

    SceneBuilder point = room();
    point.sphere({0.4f, -0.6f, 0.0f}, 0.4f, plastic(red, 0.5f)).ceiling(lambertian(white));
    point.light(PointLightDesc{.position = {-0.3f, 0.5f, 0.3f}, .intensity = Rgb(2.0f)});
    cases.push_back(in_room("point light", std::move(point)));

    SceneBuilder spot = room();
    spot.sphere({0.4f, -0.6f, 0.0f}, 0.4f, lambertian(red)).ceiling(lambertian(white));
    spot.light(SpotLightDesc{.position = {-0.5f, 0.8f, 0.3f},
                             .direction = {0.4f, -1.0f, -0.2f},
                             .intensity = Rgb(4.0f),
                             .inner_cone_angle = 0.2f,
                             .outer_cone_angle = 0.8f});
    cases.push_back(in_room("spot light", std::move(spot)));

    SceneBuilder sun = room();
    sun.sphere({0.4f, -0.6f, 0.0f}, 0.4f, lambertian(red));
    sun.light(DirectionalLightDesc{.direction = {0.3f, -1.0f, -0.4f}, .illuminance = Rgb(3.0f)});
    cases.push_back(in_room("sun", std::move(sun)));

    SceneBuilder constant = room();
    constant.sphere({0.4f, -0.6f, 0.0f}, 0.4f, glass(0.0f));
    constant.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    cases.push_back(in_room("constant environment", std::move(constant), std::nullopt));

    SceneBuilder sky = room();
    sky.sphere({0.4f, -0.6f, 0.0f}, 0.4f, metal(white, 0.3f));
    sky.light(EnvironmentLightDesc{
        .radiance = gradient_sky(),
        .world_from_environment = Mat3(glm::rotate(Mat4(1.0f), 0.5f, Vec3(0.6f, 0.8f, 0.0f)))});
    cases.push_back(in_room("environment image", std::move(sky), 2));
    cases.back().detectable_bias_of_light_sampling = 0.05;  // most of the sky lights nothing

    SceneBuilder mixed = room();
    mixed.lamp(0.9f, 0.4f, Rgb(3.0f));
    mixed.light(PointLightDesc{.position = {0.5f, 0.2f, 0.5f}, .intensity = {0.5f, 0.1f, 0.1f}});
    mixed.light(DirectionalLightDesc{.direction = {-0.2f, -1.0f, -0.3f}, .illuminance = Rgb(0.5f)});
    mixed.light(EnvironmentLightDesc{.radiance = gradient_sky()});
    cases.push_back(in_room("all kinds of light", std::move(mixed), 2));
}

void add_sphere_lights(std::vector<EqualityCase>& cases)
{
    SceneBuilder ball = room();
    ball.sphere({0.4f, -0.6f, 0.0f}, 0.4f, plastic(red, 0.5f)).ceiling(lambertian(white));
    ball.light(PointLightDesc{
        .position = {-0.3f, 0.4f, 0.2f}, .intensity = {2.0f, 1.8f, 1.5f}, .radius = 0.4f});
    cases.push_back(in_room("sphere light", std::move(ball)));

    // The sphere pokes through the ceiling and the cone cuts what is seen of it.
    SceneBuilder spot = room();
    spot.sphere({0.4f, -0.6f, 0.0f}, 0.4f, lambertian(red)).ceiling(lambertian(white));
    spot.light(SpotLightDesc{.position = {-0.4f, 0.9f, 0.1f},
                             .direction = {0.4f, -1.0f, -0.2f},
                             .intensity = Rgb(4.0f),
                             .inner_cone_angle = 0.4f,
                             .outer_cone_angle = 1.2f,
                             .radius = 0.5f});
    EqualityCase cut = in_room("sphere spot light", std::move(spot));
    cut.detectable_bias = 0.04;  // few of the samples of pt leave the sphere within its cone
    cases.push_back(std::move(cut));

    SceneBuilder behind_glass = room(plastic(white, 0.3f));
    behind_glass.ceiling(lambertian(white));
    behind_glass.light(
        PointLightDesc{.position = {0.0f, -0.1f, 0.0f}, .intensity = Rgb(1.0f), .radius = 0.2f});
    behind_glass.sphere({0.0f, -0.1f, 0.0f}, 0.45f, glass(0.0f));
    cases.push_back(
        in_room("sphere light in a sphere of glass", std::move(behind_glass), std::nullopt));

    // Two spheres and a mirror: each hides the other, and both are seen twice.
    SceneBuilder mixed = room();
    mixed.sphere({-0.5f, -0.6f, 0.2f}, 0.35f, metal(Rgb(0.9f), 0.0f)).lamp(0.98f, 0.4f, Rgb(2.0f));
    mixed.light(
        PointLightDesc{.position = {0.4f, 0.1f, 0.0f}, .intensity = Rgb(0.5f), .radius = 0.2f});
    mixed.light(PointLightDesc{
        .position = {0.1f, -0.3f, 0.4f}, .intensity = {0.1f, 0.5f, 0.2f}, .radius = 0.3f});
    cases.push_back(in_room("sphere lights, lamp and mirror", std::move(mixed), std::nullopt));
}

/// A screen with a bright spot, a dim one, and much that is black.
EqualityCase textured_emitter()
{
    SceneBuilder builder = room();
    TexelImage spots{.width = 4, .height = 4, .bytes = std::vector<std::uint8_t>(64, 255)};
    for (std::size_t i = 0; i < 16; ++i) {
        const std::uint8_t value = i == 5 ? 255 : i == 10 ? 160 : i % 3 == 0 ? 90 : 0;
        spots.bytes[4 * i] = value;
        spots.bytes[4 * i + 1] = value / 2;
        spots.bytes[4 * i + 2] = i == 10 ? 200 : value;
    }
    builder.desc.images.push_back(spots);
    MaterialDesc screen = emitter(Rgb(12.0f));
    screen.emission_texture = TextureRef{.image = ImageId{0}, .rotation = 0.4f, .scale = {1.3f, 1}};
    builder.ceiling(lambertian(white)).sphere({0.3f, -0.6f, 0.2f}, 0.4f, lambertian(green));
    builder.quad({-0.7f, -0.6f, -0.8f}, {0.7f, -0.6f, -0.8f}, {0.7f, 0.7f, -0.6f},
                 {-0.7f, 0.7f, -0.6f}, screen);
    return in_room("textured emitter", std::move(builder));
}

/// A room that is lit and seen through its front, a clear sheet.
EqualityCase room_with_window()
{
    SceneBuilder builder = room(plastic(white, 0.4f));
    builder.ceiling(lambertian(white)).front(thin_glass(0.0f));
    builder.sphere({0.3f, -0.6f, 0.2f}, 0.4f, lambertian(green));
    builder.light(EnvironmentLightDesc{.radiance = gradient_sky()});
    return in_room("room with a window", std::move(builder), std::nullopt);
}

/// The same with stained glass: the colours of a texture and of vertices.
EqualityCase stained_window()
{
    SceneBuilder builder = room(plastic(white, 0.4f));
    TexelImage stains{
        .width = 2,
        .height = 2,
        .bytes = {255, 40, 20, 255, 240, 240, 240, 255, 30, 90, 255, 255, 0, 0, 0, 255}};
    builder.desc.images.push_back(stains);
    MaterialDesc stained = thin_glass(0.0f);
    stained.base_color_texture = TextureRef{.image = ImageId{0}, .scale = {2, 2}};
    builder.ceiling(lambertian(white)).front(stained);
    builder.desc.meshes.back().colors = {
        {1, 1, 1, 1}, {1, 0.5f, 1, 1}, {0.5f, 1, 1, 1}, {1, 1, 0.5f, 1}};
    builder.sphere({0.3f, -0.6f, 0.2f}, 0.4f, lambertian(green));
    builder.light(EnvironmentLightDesc{.radiance = gradient_sky()});
    return in_room("room with a stained window", std::move(builder), std::nullopt);
}

void add_materials(std::vector<EqualityCase>& cases)
{
    const auto with_sphere = [&](std::string name, const MaterialDesc& material,
                                 std::optional<int> seen_by_lt = 1) {
        SceneBuilder builder = lit_room();
        builder.sphere({0.0f, -0.4f, 0.0f}, 0.55f, material);
        cases.push_back(in_room(std::move(name), std::move(builder), seen_by_lt));
    };
    with_sphere("plastic", plastic(red, 0.3f));
    with_sphere("smooth plastic", plastic(red, 0.0f), std::nullopt);
    with_sphere("rough metal", metal({0.9f, 0.7f, 0.4f}, 0.4f));
    with_sphere("mirror", metal(Rgb(0.95f), 0.0f), std::nullopt);
    MaterialDesc thin = thin_glass(0.0f);
    with_sphere("clear sheet", thin, std::nullopt);
    thin.base_color = {0.5f, 0.5f, 0.5f, 1.0f};
    with_sphere("clear sheet, grey", thin, std::nullopt);
    thin.base_color = {0.9f, 0.7f, 0.5f, 1.0f};
    with_sphere("clear sheet, tinted", thin, std::nullopt);
    cases.push_back(room_with_window());
    cases.push_back(stained_window());
    with_sphere("rough thin glass", thin_glass(0.5f));
    with_sphere("rough glass", glass(0.4f));
    cases.back().detectable_bias_of_light_sampling = 0.05;
    MaterialDesc tinted = glass(0.0f);
    tinted.attenuation_color = {0.9f, 0.4f, 0.2f};
    tinted.attenuation_distance = 0.5f;
    with_sphere("tinted glass", tinted, std::nullopt);
    MaterialDesc half = glass(0.3f);
    half.base_color = {0.5f, 0.8f, 0.6f, 1.0f};
    half.transmission = 0.5f;
    half.ior = 1.33f;
    with_sphere("half transmission", half);
    cases.push_back(in_room("glossy floor", lit_room(plastic(white, 0.15f))));
}

/// A view from the side through a lens whose film is shifted back to the room, with oblong pixels.
EqualityCase shifted_film(std::string name, float lens_radius)
{
    SceneBuilder builder = lit_room(plastic(white, 0.3f));
    builder.sphere({0.1f, -0.4f, 0.0f}, 0.5f, lambertian(red), 24);
    EqualityCase result = in_room(std::move(name), std::move(builder));
    const Vec3 eye(-2.0f, 1.1f, 3.4f);
    result.camera = camera_at(eye, eye - Vec3(0.0f, 0.0f, 1.0f), 0.75f);
    result.camera.pixel_aspect = 1.5f;
    result.camera.shift = {0.5f, -0.4f};
    result.camera.lens_radius = lens_radius;
    result.camera.focus_distance = 3.4f;
    return result;
}

}  // namespace

std::vector<EqualityCase> silhouette_cases()
{
    // Octahedra with the normals of spheres, turned so that the lens sees much of what faces away.
    const auto turned = [](Vec3 center, float angle) {
        return glm::scale(
            glm::rotate(glm::translate(Mat4(1.0f), center), angle, Vec3(0.0f, 1.0f, 0.0f)),
            Vec3(0.8f));
    };
    const auto spheres = [&](const MaterialDesc& left, const MaterialDesc& right) {
        SceneBuilder builder = lit_room();
        const MeshId mesh = builder.sphere_mesh(4);
        builder.place(mesh, left, turned({-0.5f, -0.1f, 0.4f}, 0.45f));
        builder.place(mesh, right, turned({0.5f, -0.1f, 0.4f}, -0.45f));
        return builder;
    };
    std::vector<EqualityCase> cases{
        in_room("lambertian and plastic", spheres(lambertian(white), plastic(red, 0.3f))),
        in_room("metal and lambertian, through a lens",
                spheres(metal(green, 0.5f), lambertian(white)))};
    // Light paths can hit a large lens, too, and do not sample directions to it here.
    cases.back().camera.lens_radius = 0.3f;
    cases.back().camera.focus_distance = 3.0f;
    return cases;
}

std::vector<EqualityCase> equality_cases()
{
    std::vector<EqualityCase> cases;
    add_lights(cases);
    add_sphere_lights(cases);
    cases.push_back(textured_emitter());
    add_materials(cases);
    cases.push_back(shading_normals());
    cases.push_back(mirrored_instances());
    cases.push_back(textures());
    cases.push_back(scaled("millimetres", 1e-3f, Vec3(0.0f)));
    cases.push_back(scaled("kilometres, far from the origin", 1e3f, {3e3f, -2e3f, 5e3f}));
    for (EqualityCase& with_alpha : alpha_cases()) {
        cases.push_back(std::move(with_alpha));
    }
    cases.push_back(sunny_sky());
    cases.push_back(shifted_film("shifted film", 0.0f));
    cases.push_back(shifted_film("shifted film behind a lens", 0.3f));
    return cases;
}

}  // namespace bdpt::test
