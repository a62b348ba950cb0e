#pragma once
/// How often anything in this program has asked for memory by operator new.
#include <cstddef>

std::size_t allocations();
