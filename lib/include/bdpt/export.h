#pragma once

/// Marks what users of the shared library may call or catch; everything else stays inside.
#define BDPT_EXPORT [[gnu::visibility("default")]]
