#include "vdb_fixture.h"

namespace bdpt::test {

std::filesystem::path VdbFiles::write(const std::vector<openvdb::GridBase::Ptr>& grids)
{
    const std::filesystem::path file = folder_ / (std::to_string(count_++) + ".vdb");
    openvdb::io::File(file.string()).write(grids);
    return file;
}

std::filesystem::path VdbFiles::write(const std::string& bytes)
{
    const std::filesystem::path file = folder_ / (std::to_string(count_++) + ".vdb");
    write_text(file, bytes);
    return file;
}

openvdb::FloatGrid::Ptr density_grid(openvdb::Coord first, openvdb::Coord last,
                                     const std::function<float(openvdb::Coord)>& density)
{
    auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName("density");
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    for (auto i = openvdb::CoordBBox(first, last).begin(); i; ++i) {
        grid->tree().setValue(*i, density(*i));
    }
    return grid;
}

openvdb::FloatGrid::Ptr askew_grid()
{
    auto grid = density_grid({-2, 3, 9}, {4, 7, 11}, [](openvdb::Coord i) {
        return 0.25f * static_cast<float>(100 * (i.x() + 2) + 10 * (i.y() - 3) + (i.z() - 9) + 1);
    });
    auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    transform->postScale(openvdb::Vec3d(1.0, 1.5, 2.0));
    transform->postRotate(0.6, openvdb::math::X_AXIS);
    transform->postRotate(-1.1, openvdb::math::Z_AXIS);
    transform->postTranslate(openvdb::Vec3d(0.4, -7.0, 2.5));
    grid->setTransform(transform);
    return grid;
}

openvdb::FloatGrid::Ptr small_grid()
{
    return density_grid({0, 0, 0}, {3, 3, 3}, [](openvdb::Coord) { return 2.0f; });
}

}  // namespace bdpt::test
