// SPDX-License-Identifier: LGPL-2.1-or-later
// A target of precompiled headers has a source.
