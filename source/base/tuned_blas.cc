// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/tuned_blas.h"

#include <dlfcn.h>

#include <initializer_list>

namespace taut
{
  bool has_tuned_blas()
  {
    for (const char *const name :
         {"openblas_get_config", "bli_info_get_version_str", "MKL_Get_Version_String"})
      if (dlsym(RTLD_DEFAULT, name) != nullptr)
        return true;
    return false;
  }
} // namespace taut
