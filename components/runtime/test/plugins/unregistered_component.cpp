// SPDX-License-Identifier: Apache-2.0
// Includes the header but registers nothing: a forgotten PANVO_REGISTER_COMPONENT.
#include "panvo/runtime/component.hpp"
