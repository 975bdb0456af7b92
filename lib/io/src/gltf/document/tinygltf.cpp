#include <algorithm>
#include <fstream>
#include <iomanip>
#include <sstream>

#define TINYGLTF_IMPLEMENTATION
#include "gltf/document/tinygltf.h"
