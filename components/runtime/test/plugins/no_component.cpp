// SPDX-License-Identifier: Apache-2.0
extern "C" int a_library_of_something_else() { return 1; }
