#include "vdb_reader/grid_choice.h"

#include <bdpt/error.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace bdpt::vdb {

namespace {

using openvdb::GridBase;

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

}  // namespace

std::string plain(const std::string& text, std::size_t most)
{
    std::string result = text.substr(0, most);
    std::replace_if(
        result.begin(), result.end(), [](char c) { return c < ' ' || c == '\x7f'; }, '?');
    return text.size() > most ? result + "..." : result;
}

std::string label(const GridBase& grid)
{
    return "grid \"" + plain(grid.getName()) + "\": ";
}

std::string chosen_grid(openvdb::io::File& file, const std::string& wanted)
{
    const std::vector<Head> heads = read_heads(file);
    const Head& head = chosen(heads, wanted);
    check(*head.grid);
    return head.name;
}

}  // namespace bdpt::vdb
