// Renders a grey box with a lamp, made in code, and compares its brightness with what the balance
// of energy says. The first line of the output is the version.
#include <bdpt/error.h>
#include <bdpt/render.h>
#include <bdpt/version.h>

#include <cstdint>
#include <cstdio>
#include <utility>

namespace {

constexpr float albedo = 0.5f;
constexpr float lamp_radiance = 10.0f;  // [nit]
constexpr float lamp_side = 1.0f;       // [m]

bdpt::MeshDesc quad(bdpt::Vec3 corner, bdpt::Vec3 side, bdpt::Vec3 other_side)
{
    bdpt::MeshDesc mesh;
    mesh.positions = {corner, corner + side, corner + side + other_side, corner + other_side};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

void add(bdpt::SceneDesc& scene, bdpt::MeshDesc mesh, bdpt::MaterialId material)
{
    bdpt::InstanceDesc instance;
    instance.mesh = bdpt::MeshId{static_cast<std::uint32_t>(scene.meshes.size())};
    instance.material = material;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back(instance);
}

/// Six walls around [-1, 1]^3 [m] and a lamp below the ceiling that shines down.
bdpt::SceneDesc make_box()
{
    bdpt::SceneDesc scene;
    bdpt::MaterialDesc grey;
    grey.base_color = {albedo, albedo, albedo, 1.0f};
    grey.metallic = 0.0f;
    grey.specular = 0.0f;  // what is left is Lambert's law
    bdpt::MaterialDesc lamp = grey;
    lamp.emission = bdpt::Rgb(lamp_radiance);
    scene.materials = {grey, lamp};

    const bdpt::Vec3 x{2.0f, 0.0f, 0.0f};
    const bdpt::Vec3 y{0.0f, 2.0f, 0.0f};
    const bdpt::Vec3 z{0.0f, 0.0f, 2.0f};
    const bdpt::Vec3 low{-1.0f};
    const bdpt::Vec3 high{1.0f};
    const bdpt::MaterialId wall{0};
    add(scene, quad(low, x, y), wall);
    add(scene, quad(low, y, z), wall);
    add(scene, quad(low, z, x), wall);
    add(scene, quad(high, -x, -y), wall);
    add(scene, quad(high, -y, -z), wall);
    add(scene, quad(high, -z, -x), wall);
    const float half = 0.5f * lamp_side;
    add(scene, quad({-half, 0.99f, -half}, 0.5f * lamp_side * x, 0.5f * lamp_side * z),
        bdpt::MaterialId{1});
    return scene;
}

/// Mean radiance [nit] of a view of the back wall.
float render_mean(const bdpt::Scene& scene)
{
    bdpt::CameraDesc camera;
    camera.world_from_camera[3] = {0.0f, 0.0f, 0.9f, 1.0f};
    camera.vertical_fov = 0.9f;
    bdpt::RenderOptions options;
    options.film.width = 32;
    options.film.height = 32;
    options.sampling.samples = {0, 4};
    const bdpt::Image image = bdpt::render(scene, camera, options).film.develop();
    float sum = 0.0f;
    for (const bdpt::Rgb& pixel : image.pixels) {
        sum += pixel.g;
    }
    return sum / static_cast<float>(image.pixels.size());
}

/// An error from inside the library arrives as what it is.
bool refuses_missing_mesh()
{
    bdpt::SceneDesc broken = make_box();
    broken.instances.front().mesh = bdpt::MeshId{99};
    try {
        const bdpt::Scene scene(std::move(broken));
    } catch (const bdpt::Error& error) {
        std::printf("as expected: %s\n", error.what());
        return error.code() == bdpt::ErrorCode::invalid_input;
    }
    return false;
}

}  // namespace

int main()
{
    std::printf("bdpt %d.%d.%d\n", bdpt::version_major, bdpt::version_minor, bdpt::version_patch);
    const bdpt::Scene scene(make_box());
    const float mean = render_mean(scene);
    // In a closed box the light that the walls take in, A E (1 - albedo), is what the lamp gives,
    // pi L a. The mean radiance of all walls is albedo E / pi; one wall is within a factor of two.
    const float area = 24.0f;
    const float all_walls = albedo / (1.0f - albedo) * lamp_radiance * lamp_side * lamp_side / area;
    std::printf("mean radiance %.4f nit; that of all walls: %.4f nit\n", mean, all_walls);
    const bool plausible = mean > 0.5f * all_walls && mean < 2.0f * all_walls;
    return plausible && refuses_missing_mesh() ? 0 : 1;
}
