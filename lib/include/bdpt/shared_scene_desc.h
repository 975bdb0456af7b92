#pragma once

/// @file
/// Shares the lists of a description with its copies, so that edits are quick.
///
/// @code{.cpp}
/// void move_last_instance(bdpt::Scene& scene)
/// {
///     bdpt::SharedSceneDesc desc = scene.description();            // shares all lists
///     std::vector<bdpt::InstanceDesc> instances = desc.instances;  // copies one
///     instances.back().world_from_object[3].x += 0.1f;
///     desc.instances = std::move(instances);
///     scene = scene.edited(desc);
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace bdpt {

/// An immutable list whose copies share its values. To change an item, copy the values to a vector
/// and construct a new list.
template <typename T>
class SharedList {
public:
    SharedList() = default;
    /// Constructs a list of `values`. Not explicit: values are a list.
    SharedList(std::vector<T> values)
        : values_(std::make_shared<const std::vector<T>>(std::move(values)))
    {}
    // Not movable: a list always has values.
    SharedList(const SharedList&) = default;
    SharedList& operator=(const SharedList&) = default;
    ~SharedList() = default;

    [[nodiscard]] const std::vector<T>& values() const { return *values_; }
    /// Converts to the values. Not explicit: a list reads like its values, and can be copied to a
    /// vector.
    operator const std::vector<T>&() const { return *values_; }

    [[nodiscard]] bool empty() const { return values_->empty(); }
    [[nodiscard]] std::size_t size() const { return values_->size(); }
    [[nodiscard]] const T& operator[](std::size_t i) const { return (*values_)[i]; }
    [[nodiscard]] const T* data() const { return values_->data(); }
    [[nodiscard]] auto begin() const { return values_->begin(); }
    [[nodiscard]] auto end() const { return values_->end(); }

    /// Tests whether this list and `other` share their values.
    [[nodiscard]] bool is_shared_with(const SharedList& other) const
    {
        return values_ == other.values_;
    }

private:
    [[nodiscard]] static const std::shared_ptr<const std::vector<T>>& none()
    {
        static const auto values = std::make_shared<const std::vector<T>>();
        return values;
    }

    std::shared_ptr<const std::vector<T>> values_ = none();
};

/// A `SceneDesc` whose lists are shared by all copies: the description that a scene was built from,
/// and the starting point of edits (`Scene::edited`).
struct BDPT_EXPORT SharedSceneDesc {
    SharedSceneDesc() = default;
    /// Takes over `desc`. Not explicit: it has the same meaning.
    SharedSceneDesc(SceneDesc desc);
    /// Copies all lists, which takes much memory for a large scene.
    [[nodiscard]] SceneDesc copy() const;

    /// Returns all members, in the order of those of `SceneDesc`.
    [[nodiscard]] auto members() const
    {
        return std::tie(images, materials, meshes, instances, profiles, lights, texture_filter,
                        contacts, fog, volumes, origin);
    }

    SharedList<TexelImage> images;
    SharedList<MaterialDesc> materials;
    SharedList<MeshDesc> meshes;
    SharedList<InstanceDesc> instances;
    SharedList<LightProfile> profiles;
    SharedList<LightDesc> lights;
    TextureFilter texture_filter = TextureFilter::bilinear;
    ContactKind contacts = ContactKind::automatic;
    std::optional<MediumDesc> fog{};
    SharedList<VolumeDesc> volumes;
    DVec3 origin{0.0};
};

}  // namespace bdpt
