#include "scene/contacts/contacts.h"

#include "material/medium.h"
#include "math/rgb.h"
#include "scene/contacts/box_tree.h"
#include "scene/contacts/contact_faces.h"
#include "scene/contacts/mesh_topology.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace bdpt {
namespace {

/// A displacement of a face.
struct Shift {
    Vec3 direction;  ///< unit
    float length;    ///< [m]
};

/// The search for contacts in a scene, and what they do.
class ContactSearch {
public:
    ContactSearch(const SharedSceneDesc& desc, std::span<const PlacedMesh> placed,
                  std::span<const ContactPart> parts, const ShellTable& shells)
        : desc_(desc), placed_(placed), parts_(parts), shells_(shells)
    {}

    [[nodiscard]] Contacts run();

private:
    [[nodiscard]] std::vector<Bounds> instance_boxes() const;
    /// Returns the faces of an instance that are near another movable shell, and all those of
    /// shells that may be thin.
    [[nodiscard]] std::vector<ContactFace> near_faces(std::uint32_t instance) const;
    /// Finds the faces that move where they touch, and then those which they may touch.
    void find_faces();
    [[nodiscard]] std::vector<Touch> find_touches();
    /// Returns the distance to the nearest face of the same shell that looks the other way, up to
    /// `farthest`.
    [[nodiscard]] float thickness(const ContactFace& face, float farthest) const;
    [[nodiscard]] bool is_movable(std::uint32_t instance) const
    {
        return parts_[instance].role != ContactRole::sheet;
    }
    [[nodiscard]] const Shells& shells_of(std::uint32_t instance) const
    {
        return *shells_.at(static_cast<std::size_t>(desc_.instances[instance].mesh));
    }
    [[nodiscard]] bool is_body(const ContactFace& face) const
    {
        return parts_[face.instance].role == ContactRole::body;
    }
    [[nodiscard]] bool is_closed(const ContactFace& face) const
    {
        return shells_of(face.instance).are_closed[face.shell];
    }
    /// Returns how far `face` moves because it touches `other` [m].
    [[nodiscard]] float shift(const ContactFace& face, const ContactFace& other) const;
    [[nodiscard]] Vec3 direction(const ContactFace& face) const
    {
        return is_body(face) || is_closed(face) ? -face.normal : face.normal;
    }
    /// Returns which faces are bonded.
    [[nodiscard]] std::vector<bool> find_bonded_faces(std::span<const Touch> touches) const;
    /// Keeps the bonded faces of the first of two shells as their boundary, and drops the others.
    void bond(std::span<const Touch> touches, const std::vector<bool>& bonded,
              Contacts& result) const;
    [[nodiscard]] MeshDesc moved(std::size_t mesh,
                                 const std::map<std::uint32_t, Shift>& shifts) const;

    const SharedSceneDesc& desc_;
    std::span<const PlacedMesh> placed_;
    std::span<const ContactPart> parts_;
    const ShellTable& shells_;
    std::vector<ContactFace> faces_;
    std::size_t movable_ = 0;  // number of faces that may move, the first of all
    /// The faces of an instance.
    struct Group {
        std::uint32_t begin = 0;  // index of the first
        BoxTree tree;
    };
    std::vector<Group> groups_;               // by instance
    BoxTree boxes_;                           // of the instances
    std::vector<std::atomic<bool>> is_thin_;  // by instance
};

std::vector<Bounds> ContactSearch::instance_boxes() const
{
    std::vector<Bounds> boxes(placed_.size());
    tbb::parallel_for(std::size_t{0}, placed_.size(), [&](std::size_t i) {
        Bounds& box = boxes[i];
        box = empty_bounds();
        for (std::size_t v = 0; v < placed_[i].mesh().positions.size(); ++v) {
            const Vec3 p = placed_[i].world_point_at(0, v);
            box = {.min = min(box.min, p), .max = max(box.max, p)};
        }
    });
    return boxes;
}

std::vector<ContactFace> ContactSearch::near_faces(std::uint32_t instance) const
{
    constexpr float margin = 32.0f;  // [errors] opposite faces of a thin body belong to it
    constexpr std::uint32_t block_size = 65536;
    const PlacedMesh& placed = placed_[instance];
    const ShellNeighbors shells = is_movable(instance)
                                      ? ShellNeighbors(placed, shells_of(instance), margin)
                                      : ShellNeighbors();
    const Bounds& own = boxes_.boxes()[instance];
    const float far = margin * error_in(own);
    std::optional<Bounds> region;  // around all that the instance may touch
    boxes_.find({.min = own.min - far, .max = own.max + far}, [&](std::uint32_t other) {
        if (other == instance ? shells.any() : is_movable(instance) || is_movable(other)) {
            const Bounds& box = boxes_.boxes()[other];
            region = region ? joined(*region, box) : box;
        }
        return true;
    });
    if (!region) {
        return {};
    }
    const auto find_in = [&](std::uint32_t begin, std::uint32_t end) {
        std::vector<ContactFace> faces;
        for (std::uint32_t t = begin; t < end; ++t) {
            const auto corners = placed.corners(t, 0.0f);
            if (!overlap(box_around(corners, far), *region)) {
                continue;
            }
            auto face = make_face(placed, instance, t);
            if (!face) {
                continue;
            }
            face->shell = is_movable(instance) ? shells_of(instance).of_triangles[t] : 0;
            bool is_near = shells.is_near(*face);
            if (!is_near) {
                boxes_.find(face->box(margin), [&](std::uint32_t other) {
                    is_near = other != instance && (is_movable(instance) || is_movable(other));
                    return !is_near;
                });
            }
            if (is_near) {
                faces.push_back(*face);
            }
        }
        return faces;
    };
    const std::uint32_t count = placed.triangle_count();
    std::vector<std::vector<ContactFace>> blocks(count / block_size + 1);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
        const auto begin = static_cast<std::uint32_t>(block) * block_size;
        blocks[block] = find_in(begin, begin + std::min(block_size, count - begin));
    });
    std::vector<ContactFace> faces = std::move(blocks.front());
    for (std::size_t block = 1; block < blocks.size(); ++block) {
        faces.insert(faces.end(), blocks[block].begin(), blocks[block].end());
    }
    return faces;
}

void ContactSearch::find_faces()
{
    boxes_ = BoxTree(instance_boxes());
    const auto count = static_cast<std::uint32_t>(placed_.size());
    groups_.resize(count);
    std::vector<std::vector<ContactFace>> near(count);
    tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) {
        near[i] = near_faces(i);
        std::vector<Bounds> boxes;
        boxes.reserve(near[i].size());
        for (const ContactFace& face : near[i]) {
            boxes.push_back(face.box(2.0f));
        }
        groups_[i].tree = BoxTree(std::move(boxes));
    });
    const auto append = [&](bool movable) {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (is_movable(i) == movable) {
                groups_[i].begin = static_cast<std::uint32_t>(faces_.size());
                faces_.insert(faces_.end(), near[i].begin(), near[i].end());
            }
        }
    };
    append(true);
    movable_ = faces_.size();
    append(false);
}

std::vector<Touch> ContactSearch::find_touches()
{
    // More faces at one place are z-fighting; the order of the trees decides which are compared.
    constexpr int max_comparisons = 1024;
    constexpr std::size_t max_touches = 64;
    std::vector<std::vector<Touch>> of_faces(movable_);
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(movable_), [&](std::uint32_t i) {
        const ContactFace& face = faces_[i];
        int comparisons = 0;
        const auto compare = [&](std::uint32_t k) {
            const ContactFace& other = faces_[k];
            const bool is_own = face.is_of_shell(other);
            if (is_own && dot(face.normal, other.normal) >= 0.0f) {
                return true;  // a neighbour, or the face itself
            }
            if (const float area = touching_area(face, other); area > 0.0f) {
                if (is_own) {
                    is_thin_[face.instance] = true;
                } else {
                    of_faces[i].push_back({i, k, area});
                }
            }
            return ++comparisons < max_comparisons && of_faces[i].size() < max_touches;
        };
        boxes_.find(face.box(2.0f), [&](std::uint32_t instance) {
            const Group& group = groups_[instance];
            bool goes_on = true;
            group.tree.find(face.box(2.0f), [&](std::uint32_t k) {
                goes_on = compare(group.begin + k);
                return goes_on;
            });
            return goes_on;
        });
    });
    std::vector<Touch> all;
    for (const std::vector<Touch>& some : of_faces) {
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

float ContactSearch::thickness(const ContactFace& face, float farthest) const
{
    constexpr int max_comparisons = 1024;
    ContactFace end = face;
    for (Vec3& corner : end.corners) {
        corner += farthest * direction(face);
    }
    float nearest = farthest;
    int comparisons = 0;
    const Group& group = groups_[face.instance];
    group.tree.find(joined(face.box(0.0f), end.box(0.0f)), [&](std::uint32_t k) {
        const ContactFace& other = faces_[group.begin + k];
        if (face.is_of_shell(other) && dot(face.normal, other.normal) < -0.9f) {
            const FaceOverlap shape = overlap_of(face, other);
            for (std::size_t c = 0; c < shape.count; ++c) {
                const float depth = dot(shape.corners[c] - face.corners[0], direction(face));
                nearest = depth > 0.0f ? std::min(nearest, depth) : nearest;
            }
        }
        return ++comparisons < max_comparisons;
    });
    return nearest;
}

float ContactSearch::shift(const ContactFace& face, const ContactFace& other) const
{
    const bool same_front = dot(face.normal, other.normal) > 0.0f;
    const auto key = [](const ContactFace& f) { return std::pair(f.instance, f.triangle); };
    // A lamp that moves into the body would catch up with its face; faces of two bodies or lamps
    // with a common side move one behind the other.
    const bool other_shines = parts_[other.instance].role == ContactRole::lamp;
    const bool are_alike = is_body(face) ? is_body(other) : other_shines;
    const bool is_behind =
        are_alike ? same_front && key(face) > key(other)
                  : is_body(face) && other_shines && dot(direction(face), direction(other)) > 0.0f;
    return (is_behind ? 4.0f : 2.0f) * (face.error + other.error);
}

/// Returns a displacement of a vertex by which each of its faces is displaced enough.
Vec3 combined(std::span<const Shift> shifts)
{
    constexpr float least_cosine = 0.2f;
    Vec3 sum(0.0f);
    for (const Shift& shift : shifts) {
        sum += shift.direction;
    }
    const float size = length(sum);
    if (!(size > 0.0f)) {
        return Vec3(0.0f);
    }
    float longest = 0.0f;
    for (const Shift& shift : shifts) {
        longest = std::max(longest,
                           shift.length / std::max(least_cosine, dot(sum / size, shift.direction)));
    }
    return sum / size * longest;
}

MeshDesc ContactSearch::moved(std::size_t mesh, const std::map<std::uint32_t, Shift>& shifts) const
{
    MeshDesc result = desc_.meshes[mesh];
    const std::vector<std::uint32_t> first = weld(result.positions);
    const Shells& shells = *shells_.at(mesh);
    // Vertices at one position of one shell move together, so that the shell stays closed.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Shift>> of_vertices;
    for (const auto& [triangle, shift] : shifts) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = first[result.triangles[triangle][k]];
            of_vertices[{vertex, shells.of_triangles[triangle]}].push_back(shift);
        }
    }
    const auto append_copy = [](auto& values, std::uint32_t index) {
        if (!values.empty()) {
            values.push_back(values[index]);
        }
    };
    std::map<std::uint32_t, std::uint32_t> shell_of_vertex;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;
    std::vector<Vec3> moves(result.positions.size(), Vec3(0.0f));
    for (std::size_t t = 0; t < result.triangles.size(); ++t) {
        const std::uint32_t shell = shells.of_triangles[t];
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& vertex = result.triangles[t][k];
            const std::uint32_t place = first[vertex];
            // Shells that share a vertex get one each.
            if (const auto [at, is_new] = shell_of_vertex.try_emplace(vertex, shell);
                !is_new && at->second != shell) {
                const auto [copy, is_first] = copies.try_emplace(
                    {vertex, shell}, static_cast<std::uint32_t>(result.positions.size()));
                if (is_first) {
                    append_copy(result.positions, vertex);
                    append_copy(result.normals, vertex);
                    append_copy(result.tangents, vertex);
                    append_copy(result.uvs[0], vertex);
                    append_copy(result.uvs[1], vertex);
                    append_copy(result.colors, vertex);
                    for (MeshPose& pose : result.motion) {
                        append_copy(pose.positions, vertex);
                        append_copy(pose.normals, vertex);
                        append_copy(pose.tangents, vertex);
                    }
                    moves.emplace_back(0.0f);
                }
                vertex = copy->second;
            }
            if (const auto known = of_vertices.find({place, shell}); known != of_vertices.end()) {
                moves[vertex] = combined(known->second);
            }
        }
    }
    for (std::size_t i = 0; i < moves.size(); ++i) {
        result.positions[i] += moves[i];
        for (MeshPose& pose : result.motion) {
            pose.positions[i] += moves[i];
        }
    }
    return result;
}

std::vector<bool> ContactSearch::find_bonded_faces(std::span<const Touch> touches) const
{
    return find_bonded(faces_, touches, [this](std::uint32_t i, std::uint32_t k) {
        const std::optional<float>& a = parts_[faces_[i].instance].bonding_ior;
        const std::optional<float>& b = parts_[faces_[k].instance].bonding_ior;
        return a && b && (desc_.contacts == ContactKind::bonded || *a != *b);
    });
}

void ContactSearch::bond(std::span<const Touch> touches, const std::vector<bool>& bonded,
                         Contacts& result) const
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [i, k, area] : touches) {
        const ContactFace& face = faces_[i];
        const ContactFace& other = faces_[k];
        if (!bonded[i]) {
            continue;
        }
        if (std::pair(face.instance, face.shell) < std::pair(other.instance, other.shell)) {
            result.bonds.push_back({face.instance, face.triangle, other.instance});
            pairs.emplace(face.instance, other.instance);
            continue;
        }
        const auto mesh = static_cast<std::size_t>(desc_.instances[face.instance].mesh);
        const auto moved = result.meshes.find(mesh);
        MeshDesc& open =
            result.open
                .try_emplace(face.instance,
                             moved != result.meshes.end() ? moved->second : desc_.meshes[mesh])
                .first->second;
        UVec3& corners = open.triangles[face.triangle];
        corners = UVec3(corners.x);  // not hit by rays, and the others keep their indices
    }
    std::sort(result.bonds.begin(), result.bonds.end());
    result.bonds.erase(std::unique(result.bonds.begin(), result.bonds.end()), result.bonds.end());
    result.bonded_pairs = pairs.size();
}

Contacts ContactSearch::run()
{
    find_faces();
    is_thin_ = std::vector<std::atomic<bool>>(placed_.size());
    std::vector<float> lengths(movable_);
    const std::vector<Touch> touches = find_touches();
    const std::vector<bool> bonded = find_bonded_faces(touches);
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [i, k, area] : touches) {
        pairs.insert(std::minmax(faces_[i].instance, faces_[k].instance));
        if (bonded[i]) {
            continue;
        }
        lengths[i] = std::max(lengths[i], shift(faces_[i], faces_[k]));
        if (k < movable_) {  // a face may be one of too many that `k` touches
            lengths[k] = std::max(lengths[k], shift(faces_[k], faces_[i]));
        }
    }
    std::map<std::size_t, std::map<std::uint32_t, Shift>> shifts;  // by mesh and triangle
    for (std::size_t i = 0; i < movable_; ++i) {
        const ContactFace& face = faces_[i];
        if (!(lengths[i] > 0.0f)) {
            continue;
        }
        constexpr float share = 0.25f;  // of the thickness, as both sides may move
        const float least = share * thickness(face, lengths[i] / share);
        if (least < lengths[i]) {
            is_thin_[face.instance] = true;
        }
        const InstanceDesc& instance = desc_.instances[face.instance];
        const Mat3 linear(instance.world_from_object);
        const Vec3 in_object =
            glm::inverse(linear) * (direction(face) * std::min(lengths[i], least));
        const float size = length(in_object);
        Shift& shift = shifts[static_cast<std::size_t>(instance.mesh)]
                           .try_emplace(face.triangle, Shift{Vec3(0.0f), 0.0f})
                           .first->second;
        if (size > shift.length) {  // the farthest of all instances of the mesh
            shift = {.direction = in_object / size, .length = size};
        }
    }
    Contacts result;
    result.pairs = pairs.size();
    for (const auto& [mesh, of_triangles] : shifts) {
        result.meshes.emplace(mesh, moved(mesh, of_triangles));
    }
    bond(touches, bonded, result);
    for (std::size_t i = 0; i < is_thin_.size(); ++i) {
        if (is_thin_[i]) {
            result.thin.push_back(i);
        }
    }
    return result;
}

}  // namespace

std::vector<ContactPart> contact_parts(const SharedSceneDesc& desc)
{
    std::vector<ContactPart> parts;
    parts.reserve(desc.instances.size());
    for (const InstanceDesc& instance : desc.instances) {
        const MaterialDesc& material = desc.materials[static_cast<std::size_t>(instance.material)];
        const bool shines = !is_black(material.emission);
        if (!has_inside(material)) {
            parts.push_back({.role = shines ? ContactRole::lamp : ContactRole::sheet});
            continue;
        }
        const bool moves = !instance.motion.empty() ||
                           !desc.meshes[static_cast<std::size_t>(instance.mesh)].motion.empty();
        const bool can_bond = desc.contacts != ContactKind::air && !moves && !shines &&
                              material.alpha_mode == AlphaMode::opaque;
        parts.push_back({.role = ContactRole::body,
                         .bonding_ior = can_bond ? std::optional(material.ior) : std::nullopt});
    }
    return parts;
}

ShellTable find_shells(const SharedSceneDesc& desc, std::span<const ContactPart> parts,
                       const ShellTable& known)
{
    ShellTable result;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto mesh = static_cast<std::size_t>(desc.instances[i].mesh);
        if (parts[i].role != ContactRole::sheet && !result.contains(mesh)) {
            const auto found = known.find(mesh);
            result.emplace(mesh, found != known.end() ? found->second
                                                      : std::make_shared<const Shells>(
                                                            find_shells(desc.meshes[mesh])));
        }
    }
    return result;
}

Contacts separate_contacts(const SharedSceneDesc& desc, std::span<const PlacedMesh> placed,
                           std::span<const ContactPart> parts, const ShellTable& shells)
{
    return shells.empty() ? Contacts{} : ContactSearch(desc, placed, parts, shells).run();
}

}  // namespace bdpt
