#include "scene/contacts/contacts.h"

#include "material/medium.h"
#include "math/rgb.h"
#include "scene/contacts/box_tree.h"
#include "scene/contacts/mesh_topology.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace bdpt {
namespace {

/// Faces closer than this times the sum of their errors touch.
constexpr float reach = 1.0f;

/// A triangle in world space.
struct Face {
    std::array<Vec3, 3> corners;  ///< counter-clockwise from the front
    Vec3 normal;                  ///< unit, on the front
    float error;
    std::uint32_t instance;
    std::uint32_t triangle;

    /// Returns its bounds with `errors` times its error around.
    [[nodiscard]] Bounds box(float errors) const
    {
        const float margin = errors * error;
        return {.min = min(corners[0], min(corners[1], corners[2])) - margin,
                .max = max(corners[0], max(corners[1], corners[2])) + margin};
    }
};

/// Returns the triangle, unless it is so narrow that its normal is noise.
std::optional<Face> make_face(const PlacedMesh& placed, std::uint32_t instance,
                              std::uint32_t triangle)
{
    constexpr float min_height = 16.0f;  // times the error
    auto corners = placed.corners(triangle, 0.0f);
    if (placed.front_sign() < 0.0f) {
        std::swap(corners[1], corners[2]);
    }
    const Vec3 normal = placed.area_normal(triangle, 0.0f);
    const float area = length(normal);
    const float longest =
        std::max({distance(corners[0], corners[1]), distance(corners[1], corners[2]),
                  distance(corners[2], corners[0])});
    const float error = placed.point(triangle, Vec2(1.0f / 3.0f), 0.0f).error;
    if (!(area > min_height * error * longest)) {
        return std::nullopt;
    }
    return Face{corners, normal / area, error, instance, triangle};
}

/// The part of a plane where two triangles overlap: a convex polygon.
struct Overlap {
    std::array<Vec3, 9> corners;
    std::size_t count = 0;
};

/// Cuts off what lies beyond the edge from `a` to `b` of a triangle with that normal.
Overlap clipped(const Overlap& shape, Vec3 a, Vec3 b, Vec3 normal)
{
    const Vec3 inwards = cross(normal, b - a);
    Overlap result;
    for (std::size_t i = 0; i < shape.count; ++i) {
        const Vec3 p = shape.corners[i];
        const Vec3 q = shape.corners[(i + 1) % shape.count];
        const float of_p = dot(p - a, inwards);
        const float of_q = dot(q - a, inwards);
        if (of_p >= 0.0f) {
            result.corners[result.count++] = p;
        }
        if ((of_p >= 0.0f) != (of_q >= 0.0f)) {
            result.corners[result.count++] = p + of_p / (of_p - of_q) * (q - p);
        }
    }
    return result;
}

/// Returns the part of `b` that lies along the normal of `a` before or behind `a`.
Overlap overlap_of(const Face& a, const Face& b)
{
    Overlap shape;
    for (const Vec3& corner : b.corners) {
        shape.corners[shape.count++] = corner;
    }
    for (std::size_t i = 0; i < 3 && shape.count > 0; ++i) {
        shape = clipped(shape, a.corners[i], a.corners[(i + 1) % 3], a.normal);
    }
    return shape;
}

/// Tests whether the faces are parallel and nowhere farther apart than rays can tell, where they
/// overlap by more than that.
bool touch(const Face& a, const Face& b)
{
    constexpr float max_sine = 0.1f;
    const Vec3 sine = cross(a.normal, b.normal);
    if (dot(sine, sine) > max_sine * max_sine) {
        return false;
    }
    const float tolerance = reach * (a.error + b.error);
    if (std::abs(dot(b.corners[0] - a.corners[0], a.normal)) > tolerance &&
        std::abs(dot(b.corners[1] - a.corners[0], a.normal)) > tolerance &&
        std::abs(dot(b.corners[2] - a.corners[0], a.normal)) > tolerance) {
        return false;
    }
    const Overlap shape = overlap_of(a, b);
    Vec3 twice_area(0.0f);
    float around = 0.0f;
    for (std::size_t i = 0; i < shape.count; ++i) {
        const Vec3 p = shape.corners[i] - shape.corners[0];
        const Vec3 q = shape.corners[(i + 1) % shape.count] - shape.corners[0];
        if (std::abs(dot(shape.corners[i] - a.corners[0], a.normal)) > tolerance) {
            return false;
        }
        twice_area += cross(p, q);
        around += distance(p, q);
    }
    return length(twice_area) > 2.0f * tolerance * around;
}

/// A displacement of a face.
struct Shift {
    Vec3 direction;  ///< unit
    float length;    ///< [m]
};

/// Two faces that touch, by their index in the list of faces.
struct Touch {
    std::uint32_t face;
    std::uint32_t other;
};

/// The search for contacts in a scene, and what they do.
class ContactSearch {
public:
    ContactSearch(const SharedSceneDesc& desc, std::span<const PlacedMesh> placed,
                  std::span<const ContactRole> roles, const ShellTable& shells)
        : desc_(desc), placed_(placed), roles_(roles), shells_(shells)
    {}

    [[nodiscard]] Contacts run();

private:
    [[nodiscard]] std::vector<Bounds> instance_boxes() const;
    /// Appends the faces of an instance that are near another movable shell.
    [[nodiscard]] std::vector<Face> near_faces(std::uint32_t instance, const BoxTree& boxes) const;
    /// Finds the faces that move where they touch, and then those which they may touch.
    void find_faces();
    [[nodiscard]] std::vector<Touch> find_touches(const BoxTree& tree);
    /// Returns the distance to the nearest face of the same shell that looks the other way, up to
    /// `farthest`.
    [[nodiscard]] float thickness(const Face& face, float farthest, const BoxTree& tree) const;
    [[nodiscard]] const Shells& shells_of(const Face& face) const
    {
        return *shells_.at(static_cast<std::size_t>(desc_.instances[face.instance].mesh));
    }
    [[nodiscard]] std::uint32_t shell_of(const Face& face) const
    {
        return shells_of(face).of_triangles[face.triangle];
    }
    [[nodiscard]] bool is_one_shell(const Face& a, const Face& b) const
    {
        return a.instance == b.instance && shell_of(a) == shell_of(b);
    }
    [[nodiscard]] bool is_closed(const Face& face) const
    {
        return shells_of(face).are_closed[shell_of(face)];
    }
    /// Returns how far `face` moves because it touches `other` [m].
    [[nodiscard]] float shift(const Face& face, const Face& other) const;
    [[nodiscard]] Vec3 direction(const Face& face) const
    {
        return roles_[face.instance] == ContactRole::body || is_closed(face) ? -face.normal
                                                                             : face.normal;
    }
    [[nodiscard]] MeshDesc moved(std::size_t mesh,
                                 const std::map<std::uint32_t, Shift>& shifts) const;

    const SharedSceneDesc& desc_;
    std::span<const PlacedMesh> placed_;
    std::span<const ContactRole> roles_;
    const ShellTable& shells_;
    std::vector<Face> faces_;
    std::size_t movable_ = 0;                 // number of faces that may move, the first of all
    std::vector<std::atomic<bool>> is_thin_;  // by instance
};

std::vector<Bounds> ContactSearch::instance_boxes() const
{
    std::vector<Bounds> boxes(placed_.size());
    tbb::parallel_for(std::size_t{0}, placed_.size(), [&](std::size_t i) {
        constexpr float infinite = std::numeric_limits<float>::infinity();
        Bounds& box = boxes[i];
        box = {.min = Vec3(infinite), .max = Vec3(-infinite)};
        for (std::size_t v = 0; v < placed_[i].mesh().positions.size(); ++v) {
            const Vec3 p = placed_[i].world_point_at(0, v);
            box = {.min = min(box.min, p), .max = max(box.max, p)};
        }
    });
    return boxes;
}

std::vector<Face> ContactSearch::near_faces(std::uint32_t instance, const BoxTree& boxes) const
{
    constexpr float margin = 32.0f;     // errors: opposite faces of a thin body belong to it
    constexpr float max_exact = 1e-5f;  // error in sizes of a body whose thickness is asked for
    const bool is_movable = roles_[instance] != ContactRole::sheet;
    const auto mesh = static_cast<std::size_t>(desc_.instances[instance].mesh);
    const Bounds& own = boxes.boxes()[instance];
    const Vec3 reach_of_own = max(abs(own.min), abs(own.max));
    const float error = position_error(std::max({reach_of_own.x, reach_of_own.y, reach_of_own.z}));
    const bool all = is_movable && (shells_.at(mesh)->are_closed.size() > 1 ||
                                    error > max_exact * distance(own.min, own.max));
    std::vector<Face> faces;
    for (std::uint32_t t = 0; t < placed_[instance].triangle_count(); ++t) {
        const auto face = make_face(placed_[instance], instance, t);
        bool is_near = all;
        if (face && !all) {
            boxes.find(face->box(margin), [&](std::uint32_t other) {
                is_near = other != instance && (is_movable || roles_[other] != ContactRole::sheet);
                return !is_near;
            });
        }
        if (face && is_near) {
            faces.push_back(*face);
        }
    }
    return faces;
}

void ContactSearch::find_faces()
{
    const BoxTree boxes(instance_boxes());
    std::vector<std::vector<Face>> near(placed_.size());
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(placed_.size()),
                      [&](std::uint32_t i) { near[i] = near_faces(i, boxes); });
    const auto append = [&](bool movable) {
        for (std::size_t i = 0; i < placed_.size(); ++i) {
            if ((roles_[i] != ContactRole::sheet) == movable) {
                faces_.insert(faces_.end(), near[i].begin(), near[i].end());
            }
        }
    };
    append(true);
    movable_ = faces_.size();
    append(false);
}

std::vector<Touch> ContactSearch::find_touches(const BoxTree& tree)
{
    // More faces at one place are z-fighting; the order of the tree decides which are compared.
    constexpr int max_comparisons = 1024;
    constexpr std::size_t max_touches = 64;
    std::vector<std::vector<Touch>> of_faces(movable_);
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(movable_), [&](std::uint32_t i) {
        const Face& face = faces_[i];
        int comparisons = 0;
        tree.find(face.box(2.0f * reach), [&](std::uint32_t k) {
            if (k != i && touch(face, faces_[k])) {
                if (!is_one_shell(face, faces_[k])) {
                    of_faces[i].push_back({i, k});
                } else if (dot(face.normal, faces_[k].normal) < 0.0f) {
                    is_thin_[face.instance] = true;
                }
            }
            return ++comparisons < max_comparisons && of_faces[i].size() < max_touches;
        });
    });
    std::vector<Touch> all;
    for (const std::vector<Touch>& some : of_faces) {
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

float ContactSearch::thickness(const Face& face, float farthest, const BoxTree& tree) const
{
    constexpr int max_comparisons = 1024;
    Face end = face;
    for (Vec3& corner : end.corners) {
        corner += farthest * direction(face);
    }
    float nearest = farthest;
    int comparisons = 0;
    tree.find(joined(face.box(0.0f), end.box(0.0f)), [&](std::uint32_t k) {
        const Face& other = faces_[k];
        if (is_one_shell(face, other) && dot(face.normal, other.normal) < -0.9f) {
            const Overlap shape = overlap_of(face, other);
            for (std::size_t c = 0; c < shape.count; ++c) {
                const float depth = dot(shape.corners[c] - face.corners[0], direction(face));
                nearest = depth > 0.0f ? std::min(nearest, depth) : nearest;
            }
        }
        return ++comparisons < max_comparisons;
    });
    return nearest;
}

std::vector<Bounds> boxes_of(std::span<const Face> faces)
{
    std::vector<Bounds> boxes;
    boxes.reserve(faces.size());
    for (const Face& face : faces) {
        boxes.push_back(face.box(2.0f * reach));
    }
    return boxes;
}

float ContactSearch::shift(const Face& face, const Face& other) const
{
    const bool same_front = dot(face.normal, other.normal) > 0.0f;
    const auto key = [](const Face& f) { return std::pair(f.instance, f.triangle); };
    const ContactRole role = roles_[face.instance];
    // A lamp that moves into the body would catch up with its face; faces of two bodies or lamps
    // with a common side move one behind the other.
    const bool is_behind = role == roles_[other.instance]
                               ? same_front && key(face) > key(other)
                               : role == ContactRole::body &&
                                     roles_[other.instance] == ContactRole::lamp &&
                                     dot(direction(face), direction(other)) > 0.0f;
    return (is_behind ? 4.0f : 2.0f) * reach * (face.error + other.error);
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

Contacts ContactSearch::run()
{
    find_faces();
    const BoxTree tree(boxes_of(faces_));
    is_thin_ = std::vector<std::atomic<bool>>(placed_.size());
    std::vector<float> lengths(movable_);
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [i, k] : find_touches(tree)) {
        lengths[i] = std::max(lengths[i], shift(faces_[i], faces_[k]));
        if (k < movable_) {  // a face may be one of too many that `k` touches
            lengths[k] = std::max(lengths[k], shift(faces_[k], faces_[i]));
        }
        pairs.insert(std::minmax(faces_[i].instance, faces_[k].instance));
    }
    std::map<std::size_t, std::map<std::uint32_t, Shift>> shifts;  // by mesh and triangle
    for (std::size_t i = 0; i < movable_; ++i) {
        const Face& face = faces_[i];
        if (!(lengths[i] > 0.0f)) {
            continue;
        }
        constexpr float share = 0.25f;  // of the thickness, as both sides may move
        const float least = share * thickness(face, lengths[i] / share, tree);
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
    for (std::size_t i = 0; i < is_thin_.size(); ++i) {
        if (is_thin_[i]) {
            result.thin.push_back(i);
        }
    }
    return result;
}

}  // namespace

std::vector<ContactRole> contact_roles(const SharedSceneDesc& desc)
{
    std::vector<ContactRole> roles;
    roles.reserve(desc.instances.size());
    for (const InstanceDesc& instance : desc.instances) {
        const MaterialDesc& material = desc.materials[static_cast<std::size_t>(instance.material)];
        roles.push_back(has_inside(material)          ? ContactRole::body
                        : is_black(material.emission) ? ContactRole::sheet
                                                      : ContactRole::lamp);
    }
    return roles;
}

ShellTable find_shells(const SharedSceneDesc& desc, std::span<const ContactRole> roles,
                       const ShellTable& known)
{
    ShellTable result;
    for (std::size_t i = 0; i < roles.size(); ++i) {
        const auto mesh = static_cast<std::size_t>(desc.instances[i].mesh);
        if (roles[i] != ContactRole::sheet && !result.contains(mesh)) {
            const auto found = known.find(mesh);
            result.emplace(mesh, found != known.end() ? found->second
                                                      : std::make_shared<const Shells>(
                                                            find_shells(desc.meshes[mesh])));
        }
    }
    return result;
}

Contacts separate_contacts(const SharedSceneDesc& desc, std::span<const PlacedMesh> placed,
                           std::span<const ContactRole> roles, const ShellTable& shells)
{
    return shells.empty() ? Contacts{} : ContactSearch(desc, placed, roles, shells).run();
}

}  // namespace bdpt
