// bdpt-read-vdb: reads a grid of an OpenVDB file for the library, which starts it (see
// process/reader_program.h). OpenVDB may crash, never end or request all memory on broken files,
// which ends only this process.

#include <bdpt/error.h>
#include <oneapi/tbb/global_control.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <functional>
#include <ios>
#include <iterator>
#include <new>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "process/reader_program.h"

namespace bdpt::vdb {
namespace {

using openvdb::GridBase;

/// Returns `text` for a message: on one line, and of up to `most` characters.
std::string plain(const std::string& text, std::size_t most = 80)
{
    std::string result = text.substr(0, most);
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c == '\x7f'; }, '?');
    return text.size() > most ? result + "..." : result;
}

/// Returns the start of messages about a grid.
std::string label(const GridBase& grid)
{
    return "grid \"" + plain(grid.getName()) + "\": ";
}

bool has_floats(const GridBase& grid)
{
    return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>();
}

/// A grid of the file, without its voxels.
struct Head {
    std::string name;
    GridBase::Ptr grid;
};

std::vector<Head> read_heads(openvdb::io::File& file)
{
    std::vector<Head> heads;
    for (auto name = file.beginName(); name != file.endName(); ++name) {
        heads.push_back({.name = name.gridName(), .grid = file.readGridMetadata(name.gridName())});
    }
    return heads;
}

std::string list_grids(const std::vector<Head>& heads)
{
    constexpr std::size_t most = 20;
    std::string text;
    for (std::size_t i = 0; i < std::min(heads.size(), most); ++i) {
        text += (i == 0 ? "" : ", ") + plain(heads[i].name) + " (" +
                plain(heads[i].grid->valueType()) + ")";
    }
    return heads.empty() ? "none" : heads.size() > most ? text + ", ..." : text;
}

std::vector<Head>::const_iterator named(const std::vector<Head>& heads, const std::string& name)
{
    return std::find_if(heads.begin(), heads.end(),
                        [&](const Head& head) { return head.name == name; });
}

/// Tests whether OpenVDB calls a grid `name`, or `name` with a number, as several have that name.
bool is_one_of(const std::string& unique, const std::string& name)
{
    return unique == name || (unique.starts_with(name + "[") && unique.ends_with("]"));
}

/// Throws if several grids are called `name`.
void check_unique(const std::vector<Head>& heads, const std::string& name)
{
    const auto count = std::count_if(heads.begin(), heads.end(),
                                     [&](const Head& head) { return is_one_of(head.name, name); });
    if (count > 1) {
        throw Error(ErrorCode::invalid_input,
                    std::to_string(count) + " grids are called \"" + plain(name) +
                        "\", of which one must be named by its number (--volume-grid \"" +
                        plain(name) + "[0]\"); it has " + list_grids(heads));
    }
}

const Head& chosen(const std::vector<Head>& heads, const std::string& wanted)
{
    const std::string name = wanted.empty() ? "density" : wanted;
    const auto found = named(heads, name);
    if (found != heads.end()) {
        return *found;
    }
    check_unique(heads, name);
    if (!wanted.empty()) {
        throw Error(ErrorCode::invalid_input,
                    "no grid \"" + plain(wanted) + "\"; it has " + list_grids(heads));
    }
    const auto is_candidate = [](const Head& head) { return has_floats(*head.grid); };
    const auto first = std::find_if(heads.begin(), heads.end(), is_candidate);
    if (heads.empty()) {
        throw Error(ErrorCode::invalid_input, "no grids");
    }
    if (first == heads.end()) {
        throw Error(ErrorCode::unsupported, "no float grid; it has " + list_grids(heads));
    }
    if (std::any_of(std::next(first), heads.end(), is_candidate)) {
        throw Error(ErrorCode::invalid_input,
                    "no grid \"density\", but several float grids, of which one must be named; it "
                    "has " +
                        list_grids(heads));
    }
    return *first;
}

void check(const GridBase& grid)
{
    const auto fail = [&grid](ErrorCode code, const std::string& what) {
        throw Error(code, label(grid) + what);
    };
    if (!has_floats(grid)) {
        fail(ErrorCode::unsupported,
             "its type is " + plain(grid.valueType()) + ", but must be float or double");
    }
    const openvdb::GridClass kind = grid.getGridClass();
    if (kind == openvdb::GRID_LEVEL_SET) {
        fail(ErrorCode::invalid_input,
             "a level set: distances to a surface, where densities are needed");
    }
    if (kind != openvdb::GRID_FOG_VOLUME && kind != openvdb::GRID_UNKNOWN) {
        fail(ErrorCode::invalid_input, "its class is " + GridBase::gridClassToString(kind) +
                                           ", but must be fog volume or unknown");
    }
    if (!grid.transform().isLinear()) {
        fail(ErrorCode::unsupported, "its transform is a " + plain(grid.transform().mapType()) +
                                         ", but must be affine: no frustum");
    }
}

/// Returns the name, unique in `file`, of the chosen grid: the one named `wanted` or, if that is
/// empty, "density", else the only one of floats. All that its header tells has been checked.
/// Throws `Error` (invalid_input, unsupported).
std::string chosen_grid(openvdb::io::File& file, const std::string& wanted)
{
    const std::vector<Head> heads = read_heads(file);
    const Head& head = chosen(heads, wanted);
    check(*head.grid);
    return head.name;
}

void check_version(std::istream& file)
{
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    file.read(magic.data(), magic.size());
    file.read(reinterpret_cast<char*>(&version), sizeof(version));
    if (version > openvdb::OPENVDB_FILE_VERSION) {
        throw Error(ErrorCode::unsupported,
                    "version " + std::to_string(version) + " of the format, but OpenVDB " +
                        openvdb::getLibraryVersionString() + " reads it up to version " +
                        std::to_string(openvdb::OPENVDB_FILE_VERSION));
    }
    file.seekg(0);
}

/// Reads headers of grids, using OpenVDB's base class of archives.
class Heads : private openvdb::io::Archive {
public:
    void check(std::istream& file, std::int64_t size)
    {
        readHeader(file);
        if (!inputHasGridOffsets()) {
            return;  // written to a pipe: the ends of grids are not recorded
        }
        setFormatVersion(file);
        setLibraryVersion(file);
        openvdb::MetaMap().readMeta(file);
        const std::int32_t count = readGridCount(file);
        for (std::int32_t i = 0; i < count; ++i) {
            openvdb::io::GridDescriptor head;
            head.read(file);
            const std::int64_t end = head.getEndPos();
            if (end < file.tellg() || end > size) {
                throw Error(ErrorCode::invalid_input, "broken: grid " + std::to_string(i) +
                                                          " ends at byte " + std::to_string(end) +
                                                          " of " + std::to_string(size));
            }
            head.seekToEnd(file);
        }
    }
};

/// Checks what OpenVDB does not: that the file's version is not newer than the library's, and that
/// no grid extends behind the end of the file, which would be read as zeros. Throws `Error`
/// (invalid_input, unsupported), or what OpenVDB does for broken headers of grids.
/// `openvdb::initialize()` was called.
void check_whole_file(const std::string& name)
{
    std::ifstream file(name, std::ios::binary | std::ios::ate);
    if (!file) {
        throw Error(ErrorCode::not_found, "cannot be read");
    }
    const std::int64_t size = file.tellg();
    file.seekg(0);
    file.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    try {
        check_version(file);
        Heads().check(file, size);
    } catch (const std::ios_base::failure&) {
        throw Error(ErrorCode::invalid_input, "broken: ends within the headers of its grids");
    }
}

using openvdb::Coord;
using openvdb::CoordBBox;

/// Slices written at a time: the depth of the tree's leaves.
constexpr int slab_depth = 8;

/// Calls `visit` with the grid as its actual type.
template <typename Visit>
void with_values(const openvdb::GridBase& grid, const Visit& visit)
{
    if (const auto* floats = dynamic_cast<const openvdb::FloatGrid*>(&grid)) {
        visit(*floats);
    } else {
        visit(dynamic_cast<const openvdb::DoubleGrid&>(grid));
    }
}

template <typename... Parts>
[[noreturn]] void fail(const openvdb::GridBase& grid, const Parts&... parts)
{
    std::ostringstream text;
    text << label(grid);
    (text << ... << parts);
    throw Error(ErrorCode::invalid_input, text.str());
}

void check_background(const openvdb::GridBase& grid)
{
    with_values(grid, [](const auto& values) {
        if (!(values.background() == 0)) {
            fail(values, "its background is ", values.background(),
                 ", but must be 0: infinite volumes are not supported");
        }
    });
}

/// Returns the box of the densities of `grid`: that of its active voxels, or of voxel (0, 0, 0) if
/// it has none, extended by one voxel. Throws `Error` (invalid_input) if its background is not 0,
/// or if they take more than `max_bytes`.
io::VdbReply make_header(const openvdb::GridBase& grid, std::uint64_t max_bytes)
{
    check_background(grid);
    CoordBBox box = grid.evalActiveVoxelBoundingBox();
    io::VdbReply header;
    if (box.empty()) {
        header.empty = 1;
        box = CoordBBox({0, 0, 0}, {0, 0, 0});
    }
    std::array<std::uint64_t, 3> sides{};
    std::uint64_t most = max_bytes / sizeof(float);
    constexpr std::uint64_t longest = 32768;
    bool fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t low = box.min()[axis];
        const std::int64_t high = box.max()[axis];
        sides[axis] = static_cast<std::uint64_t>(high - low + 3);  // one more on each side
        most /= sides[axis];
        fits = fits && sides[axis] <= longest && low > INT32_MIN && high < INT32_MAX;
        header.first[axis] = static_cast<std::int32_t>(low - 1);
        header.size[axis] = static_cast<std::uint32_t>(sides[axis]);
    }
    if (!fits || most == 0) {
        fail(grid, "its box of ", sides[0], " x ", sides[1], " x ", sides[2],
             " voxels is too large: the limit is ", max_bytes, " bytes, at 4 for each voxel, and ",
             longest, " voxels along a side");
    }
    // Row-major for row vectors is column-major for column vectors.
    const openvdb::Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4();
    std::copy_n(matrix.asPointer(), header.world_from_index.size(),
                header.world_from_index.begin());
    header.tree_bytes = grid.memUsage();
    const std::string name = plain(grid.getName());
    std::copy_n(name.begin(), std::min(name.size(), header.name.size() - 1), header.name.begin());
    return header;
}

/// Returns the size of all densities, or of those that are in memory at a time [bytes].
std::uint64_t density_bytes(const io::VdbReply& header)
{
    return std::uint64_t{header.size[0]} * header.size[1] * header.size[2] * sizeof(float);
}

std::uint64_t slab_bytes(const io::VdbReply& header)
{
    return std::uint64_t{header.size[0]} * header.size[1] * slab_depth * sizeof(float);
}

/// Passes these densities to `write` in pieces, x fastest.
void write_densities(const openvdb::GridBase& grid, const io::VdbReply& header,
                     const std::function<void(std::span<const float>)>& write)
{
    const Coord first(header.first[0], header.first[1], header.first[2]);
    const auto side = [&](int axis) {
        return static_cast<int>(header.size[static_cast<std::size_t>(axis)]);
    };
    const std::size_t slice = static_cast<std::size_t>(side(0)) * static_cast<std::size_t>(side(1));
    std::vector<float> values;
    for (int z = 0; z < side(2); z += slab_depth) {
        const int count = std::min(slab_depth, side(2) - z);
        const CoordBBox box(first.offsetBy(0, 0, z),
                            first.offsetBy(side(0) - 1, side(1) - 1, z + count - 1));
        values.resize(slice * static_cast<std::size_t>(count));
        openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box, values.data());
        with_values(grid, [&](const auto& tree) {
            openvdb::tools::copyToDense(tree, dense, /*serial=*/true);
        });
        write(values);
    }
}

void read(const std::string& name, const std::string& wanted, std::uint64_t max_bytes,
          io::Allowance allowance)
{
    openvdb::initialize();
    io::confine(io::Openable::to_read);
    check_whole_file(name);
    openvdb::io::File file(name);
    file.open(/*delayLoad=*/false);
    io::confine(io::Openable::none);
    const openvdb::GridBase::Ptr grid = file.readGrid(chosen_grid(file, wanted));
    const io::VdbReply header = make_header(*grid, max_bytes);
    io::write_output(&header, sizeof(header));
    // From here on the work is proportional to the densities, which `make_header` has limited.
    constexpr std::uint64_t bytes_per_second = std::uint64_t{64} << 20U;
    allowance.memory += slab_bytes(header);
    allowance.seconds += density_bytes(header) / bytes_per_second;
    io::allow(allowance);
    write_densities(*grid, header, [](std::span<const float> densities) {
        io::write_output(densities.data(), densities.size_bytes());
    });
}

int failed(ErrorCode code, const std::string& message)
{
    constexpr std::size_t most = 4000;
    std::fprintf(stderr, "bdpt-read-vdb: %s\n", plain(message, most).c_str());
    return static_cast<int>(code);
}

int run(std::span<char*> words)
{
    if (words.size() != 6) {
        return failed(ErrorCode::usage,
                      "expected FILE GRID BYTES MEMORY SECONDS; bdpt --volume starts it");
    }
    const auto number = [&](std::size_t word) { return std::strtoull(words[word], nullptr, 10); };
    const io::Allowance allowance{.memory = number(4), .seconds = number(5)};
    io::limit_process(allowance);
    // Threads would take address space without a benefit: reading is not parallel.
    const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
    try {
        read(words[1], words[2], number(3), allowance);
        return 0;
    } catch (const Error& error) {
        return failed(error.code(), error.what());
    } catch (const openvdb::LookupError& error) {  // unknown type of grid or transform
        return failed(ErrorCode::unsupported, plain(error.what(), 200));
    } catch (const std::bad_alloc&) {
        return failed(ErrorCode::invalid_input, "broken, or too large: its tree takes more than " +
                                                    std::to_string(allowance.memory) +
                                                    " bytes, the limit for a file of its size");
    } catch (const std::exception& error) {
        return failed(ErrorCode::invalid_input, std::string("broken: ") + plain(error.what(), 200));
    }
}

}  // namespace

}  // namespace bdpt::vdb

int main(int count, char** words)
{
    return bdpt::vdb::run({words, static_cast<std::size_t>(count)});
}
