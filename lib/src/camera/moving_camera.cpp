#include "camera/moving_camera.h"

#include "geometry/motion.h"

#include <span>

namespace bdpt {

Camera MovingCamera::at(float time) const
{
    return moves() ? first_.moved_to(at_time(pose_, std::span<const Mat4>(motion_), time)) : first_;
}

}  // namespace bdpt
