#pragma once
/// GL's state as hosts leave it, and what it is.
#include <vector>

#include "gl/buffer.h"

namespace manzana {

/// All that GL says of itself, of what a renderer might touch.
std::vector<GLint64> state_of_gl();

/// Whatever would spoil a picture that relies on it.
void leave_a_mess(const gl::Buffer& buffer);

}  // namespace manzana
