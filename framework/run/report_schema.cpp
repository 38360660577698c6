// SPDX-License-Identifier: MIT
#include "framework/run/report_schema.h"

#include "framework/report/run_report.h"
#ifdef KAUSTIK_HAS_EMBREE
#include "framework/audit/hit_audit.h"
#include "framework/run/caustic_errors.h"
#include "framework/run/path_account.h"
#endif

namespace kaustik::run {

nlohmann::json reportSchema() {
#ifdef KAUSTIK_HAS_EMBREE
    return report::reportSchema({{"hits", audit::hitsSchema()},
                                 {"error", errorsSchema()},
                                 {"cannot_form", unformedSchema()}});
#else
    return report::reportSchema({});
#endif
}

}  // namespace kaustik::run
