// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef Stopped_h
#define Stopped_h

namespace LightTransport
{
/// Thrown from deep inside of work that nobody wants any more; Attempt makes an outcome of it. No
/// std::exception, which libraries may catch.
struct Stopped
{
};
} // namespace LightTransport

#endif
