//VTK::System::Dec
// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Nothing is drawn: programs need a fragment shader.
void main()
{
}
