#include <bdpt/io/volume.h>

#include <bdpt/render.h>
#include <bdpt/scene.h>

#include <openvdb/tools/Interpolation.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scene/volume.h"
#include "vdb_fixture.h"

namespace bdpt::test::volume_test {
namespace {

/// The density at the index `i` of the file, in a volume whose first voxel has the index `first`.
float at(const VolumeDesc& volume, openvdb::Coord first, openvdb::Coord i)
{
    const openvdb::Coord voxel = i - first;
    const auto x = static_cast<std::size_t>(voxel.x());
    const auto y = static_cast<std::size_t>(voxel.y());
    const auto z = static_cast<std::size_t>(voxel.z());
    return volume.density.at((z * volume.size.y + y) * volume.size.x + x);
}

/// Compares densities at points of the world, between voxels and around them, with those that
/// OpenVDB finds there; `turn` takes points of the file to those of the scene.
template <typename Grid, typename Turn>
void check_lookups(const VolumeDesc& desc, const Grid& grid, const Turn& turn)
{
    const Volume volume(desc);
    const auto box = grid.evalActiveVoxelBoundingBox();
    const openvdb::tools::GridSampler<Grid, openvdb::tools::BoxSampler> sampler(grid);
    double greatest = 0.0;
    for (int k = 0; k < 2000; ++k) {
        openvdb::Vec3d index;
        const std::array<double, 3> step{0.618034, 0.754878, 0.569840};
        for (int axis = 0; axis < 3; ++axis) {
            const double u = k * step[static_cast<std::size_t>(axis)];
            const int low = box.min().asPointer()[axis] - 2;
            const int high = box.max().asPointer()[axis] + 2;
            index[axis] = low + (high - low) * (u - static_cast<double>(static_cast<int>(u)));
        }
        const openvdb::Vec3d p = grid.transform().indexToWorld(index);
        const auto expected = static_cast<double>(sampler.isSample(index));
        const Vec3 q =
            turn({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
        CAPTURE(k, index, expected);
        REQUIRE(static_cast<double>(volume.density(q)) ==
                Approx(expected).epsilon(1e-3).margin(0.02));
        greatest = std::max(greatest, expected);
    }
    CHECK(greatest > 1.0);
}

constexpr auto as_it_is = [](Vec3 p) { return p; };

/// A floor under the volume and a lamp, from the side.
Image rendered(const VolumeDesc& volume)
{
    SceneDesc scene;
    scene.volumes.push_back(volume);
    scene.lights.emplace_back(
        PointLightDesc{.position = {0.5f, 4.0f, -0.5f}, .intensity = Rgb(20.0f)});
    RenderOptions options;
    options.film.width = 16;
    options.film.height = 16;
    options.sampling.samples = {0, 8};
    options.integrator = IntegratorKind::bdpt;
    CameraDesc camera;
    camera.world_from_camera[3] = {1.5f, 1.5f, 12.0f, 1.0f};
    return render(Scene(scene), camera, options).film.develop();
}

}  // namespace

TEST_CASE("voxels of an OpenVDB file have their values and their places", "[volume]")
{
    VdbFiles files;
    const auto grid = askew_grid();
    const VolumeDesc volume =
        io::load_volume(
            files.write({grid}),
            {.extinction = {3.0f, 2.0f, 1.0f}, .albedo = {0.1f, 0.2f, 0.3f}, .anisotropy = 0.4f})
            .volume;
    CHECK(volume.name == "density");
    CHECK(volume.extinction == Rgb(3.0f, 2.0f, 1.0f));
    CHECK(volume.albedo == Rgb(0.1f, 0.2f, 0.3f));
    CHECK(volume.anisotropy == 0.4f);
    REQUIRE(volume.size == UVec3(9, 7, 5));
    const openvdb::Coord first(-3, 2, 8);
    for (auto i = openvdb::CoordBBox(first, {5, 8, 12}).begin(); i; ++i) {
        REQUIRE(at(volume, first, *i) == grid->tree().getValue(*i));
    }
    check_lookups(volume, *grid, as_it_is);
}

TEST_CASE("the place of an OpenVDB file on a map is known in double precision", "[volume]")
{
    VdbFiles files;
    auto grid = density_grid({3, 5, 7}, {3, 5, 7}, [](openvdb::Coord) { return 8.0f; });
    grid->transform().postTranslate({448000.0625, 2.0, -5411840.03125});
    const io::LoadedVolume loaded = io::load_volume(files.write({grid}));
    CHECK(loaded.translation == DVec3(448001.5625, 5.5, -5411834.53125));
    CHECK(Vec3(loaded.volume.world_from_grid[3]) == Vec3(loaded.translation));
}

TEST_CASE("a voxel of an OpenVDB file is where its index is", "[volume]")
{
    VdbFiles files;
    auto grid = density_grid({3, 5, 7}, {3, 5, 7}, [](openvdb::Coord) { return 8.0f; });
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    const VolumeDesc desc = io::load_volume(files.write({grid})).volume;
    const Volume volume(desc);
    CHECK(volume.density({1.5f, 2.5f, 3.5f}) == 8.0f);
    CHECK(volume.density({1.75f, 2.5f, 3.5f}) == 4.0f);
    CHECK(volume.density({1.5f, 2.25f, 3.5f}) == 4.0f);
    CHECK(volume.density({1.5f, 2.5f, 4.01f}) == 0.0f);
    // Blender's z is up, and its y leads away.
    const auto file = files.write({grid});
    const VolumeDesc turned_desc = io::load_volume(file, {.up = io::UpAxis::z}).volume;
    const Volume turned(turned_desc);
    CHECK(turned.density({1.5f, 3.5f, -2.5f}) == 8.0f);
    CHECK(turned.density({1.5f, 2.5f, 3.5f}) == 0.0f);
    check_lookups(turned_desc, *grid, [](Vec3 p) { return Vec3(p.x, p.z, -p.y); });
}

TEST_CASE("double and half grids are read, and all linear transforms", "[volume]")
{
    VdbFiles files;
    const auto grid = askew_grid();
    SECTION("half floats")
    {
        grid->setSaveFloatAsHalf(true);
        const VolumeDesc volume = io::load_volume(files.write({grid})).volume;
        check_lookups(volume, *grid, as_it_is);  // 0.25 to 166: exact in half precision to 0.1
    }
    SECTION("doubles")
    {
        auto doubles = openvdb::DoubleGrid::create(0.0);
        doubles->setTransform(grid->transformPtr());
        for (auto i = grid->cbeginValueOn(); i; ++i) {
            doubles->tree().setValue(i.getCoord(), static_cast<double>(*i));
        }
        doubles->setName("smoke");  // the only one of floats, of no class
        check_lookups(io::load_volume(files.write({doubles, openvdb::Int32Grid::create()})).volume,
                      *doubles, as_it_is);
    }
    SECTION("scale alone")
    {
        grid->setTransform(openvdb::math::Transform::createLinearTransform(0.3));
        check_lookups(io::load_volume(files.write({grid})).volume, *grid, as_it_is);
    }
    SECTION("translation alone")
    {
        auto transform = openvdb::math::Transform::createLinearTransform();
        transform->postTranslate(openvdb::Vec3d(5, 6, 7));
        grid->setTransform(transform);
        check_lookups(io::load_volume(files.write({grid})).volume, *grid, as_it_is);
    }
    SECTION("a rotation alone")
    {
        grid->setTransform(
            openvdb::math::Transform::Ptr(new openvdb::math::Transform(openvdb::math::MapBase::Ptr(
                new openvdb::math::UnitaryMap(openvdb::Vec3d(1, 2, 3), 0.7)))));
        check_lookups(io::load_volume(files.write({grid})).volume, *grid, as_it_is);
    }
    SECTION("a mirror")
    {
        auto transform = openvdb::math::Transform::createLinearTransform();
        transform->postScale(openvdb::Vec3d(-0.5, 0.2, 0.4));
        grid->setTransform(transform);
        check_lookups(io::load_volume(files.write({grid})).volume, *grid, as_it_is);
    }
}

TEST_CASE("tiles of an OpenVDB file are filled with voxels", "[volume]")
{
    VdbFiles files;
    auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName("density");
    grid->fill(openvdb::CoordBBox({-8, 0, 0}, {23, 17, 15}), 1.5f);
    REQUIRE(grid->tree().activeTileCount() > 0);
    const VolumeDesc volume = io::load_volume(files.write({grid})).volume;
    REQUIRE(volume.size == UVec3(34, 20, 18));
    float sum = 0.0f;
    for (const float density : volume.density) {
        sum += density;
    }
    CHECK(sum == 1.5f * 32 * 18 * 16);
    check_lookups(volume, *grid, as_it_is);
}

TEST_CASE("negative and NaN densities of an OpenVDB file are 0, with one warning", "[volume]")
{
    VdbFiles files;
    auto grid = small_grid();
    grid->tree().setValue({1, 2, 3}, -1e-6f);
    grid->tree().setValue({1, 2, 2}, std::numeric_limits<float>::quiet_NaN());
    grid->tree().setValue({-1, 0, 0}, -std::numeric_limits<float>::infinity());
    const io::LoadedVolume loaded = io::load_volume(files.write({grid}));
    const openvdb::Coord first(-2, -1, -1);
    for (const openvdb::Coord voxel : {openvdb::Coord(1, 2, 3), {1, 2, 2}, {-1, 0, 0}}) {
        CHECK(at(loaded.volume, first, voxel) == 0.0f);
    }
    CHECK(at(loaded.volume, first, {0, 0, 0}) == 2.0f);
    CHECK(loaded.warnings ==
          std::vector<std::string>{"grid \"density\": voxel (-1, 0, 0): -inf: negative and NaN "
                                   "densities are treated as 0 (and 2 more of this kind)"});
    CHECK(io::load_volume(files.write({small_grid()})).warnings.empty());
}

TEST_CASE("in an OpenVDB grid without active voxels there is nothing", "[volume]")
{
    VdbFiles files;
    auto nothing = openvdb::FloatGrid::create(0.0f);
    nothing->setName("density");
    nothing->tree().setValueOff({0, 0, 0}, 5.0f);
    const io::LoadedVolume loaded = io::load_volume(files.write({nothing}));
    CHECK(loaded.volume.density == std::vector<float>(27, 0.0f));
    CHECK(loaded.warnings == std::vector<std::string>{
                                 "grid \"density\": it has no active voxels, so nothing is there"});
    SceneDesc desc;
    desc.volumes.push_back(loaded.volume);
    CHECK_NOTHROW(Scene(std::move(desc)));
}

TEST_CASE("one of several grids of an OpenVDB file is chosen by its name", "[volume]")
{
    VdbFiles files;
    const auto density = small_grid();
    auto heat = small_grid();
    heat->setName("heat");
    heat->tree().setValue({0, 0, 0}, 7.0f);
    const auto both = files.write({heat, density});
    CHECK(io::load_volume(both).volume.name == "density");
    const VolumeDesc volume = io::load_volume(both, {.grid = "heat"}).volume;
    CHECK(volume.name == "heat");
    CHECK(at(volume, {-1, -1, -1}, {0, 0, 0}) == 7.0f);
    // Two of one name are told apart by numbers.
    auto other = heat->deepCopy();
    other->tree().setValue({0, 0, 0}, 9.0f);
    const auto twins = files.write({heat, other});
    CHECK(at(io::load_volume(twins, {.grid = "heat[0]"}).volume, {-1, -1, -1}, {0, 0, 0}) == 7.0f);
    CHECK(at(io::load_volume(twins, {.grid = "heat[1]"}).volume, {-1, -1, -1}, {0, 0, 0}) == 9.0f);
}

TEST_CASE("a volume by OpenVDB has the image of the same densities by hand, to the bit", "[volume]")
{
    VdbFiles files;
    const auto grid = small_grid();
    const VolumeDesc loaded =
        io::load_volume(files.write({grid}), {.extinction = Rgb(0.25f)}).volume;
    VolumeDesc by_hand;
    by_hand.size = {6, 6, 6};
    for (int z = 0; z < 6; ++z) {
        for (int y = 0; y < 6; ++y) {
            for (int x = 0; x < 6; ++x) {
                const bool inside = x % 5 != 0 && y % 5 != 0 && z % 5 != 0;
                by_hand.density.push_back(inside ? 2.0f : 0.0f);
            }
        }
    }
    by_hand.world_from_grid[3] = {-1.5f, -1.5f, -1.5f, 1.0f};
    by_hand.extinction = Rgb(0.25f);
    const Image image = rendered(loaded);
    CHECK(image.pixels == rendered(by_hand).pixels);
    Rgb sum(0.0f);
    for (const Rgb& pixel : image.pixels) {
        sum += pixel;
    }
    CHECK(sum.x > 0.0f);
}

}  // namespace bdpt::test::volume_test
