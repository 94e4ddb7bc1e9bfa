// What the calls of a runner (job/job.h) look like as messages: both sides of the conversation
// pack and unpack here. A request has "call", an answer "ok"; docs/formats.md lists them.
#pragma once

#include "job/job.h"
#include "wire/fields.h"
#include "wire/frame.h"

// Both sides must be of one version, and have one list of axes. It grows with every field.
enum { SB_WIRE_VERSION = 2 };
uint64_t sb_wire_axes_hash(void);

// --- requests --------------------------------------------------------------------------------

json_t *sb_wire_call(const char *call); // new reference: {"call": call}
void sb_wire_put_open(json_t *head, const struct sb_context_params *params);
bool sb_wire_get_open(const json_t *head, struct sb_context_params *params,
                      struct sb_arena *arena, struct sb_error *err);

// The programs' texts go into the payload, the rest into a new head.
void sb_wire_put_job(const struct sb_job *job, struct sb_frame *frame);
// Everything that *job points to lives in `arena`.
bool sb_wire_get_job(const struct sb_frame *frame, struct sb_job *job,
                     struct sb_arena *arena, struct sb_error *err);

json_t *sb_wire_pack_shots(const struct sb_shot *shots, int count);
bool sb_wire_get_shots(const json_t *json, struct sb_shot *shots, int limit, int *count,
                       struct sb_error *err);

// The rows of SB_IMAGE_ROWS go into the payload.
void sb_wire_put_request(const struct sb_image_request *request, struct sb_frame *frame);
// *rows: owned by the caller; request->rows points to it where there are any.
bool sb_wire_get_request(const struct sb_frame *frame, struct sb_image_request *request,
                         struct sb_image *rows, struct sb_error *err);

// --- answers ---------------------------------------------------------------------------------

json_t *sb_wire_pack_error(const struct sb_error *err);
bool sb_wire_get_error(const json_t *json, struct sb_error *told, struct sb_error *err);
json_t *sb_wire_pack_caps(const struct sb_caps *caps);
bool sb_wire_get_caps(const json_t *json, struct sb_caps *caps, struct sb_error *err);
json_t *sb_wire_pack_audit(const struct sb_audit *audit); // as read, not as judged
bool sb_wire_get_audit(const json_t *json, struct sb_audit *audit, struct sb_arena *arena,
                       struct sb_error *err);
json_t *sb_wire_pack_probe(const struct sb_probe *probe);
bool sb_wire_get_probe(const json_t *json, struct sb_probe *probe, struct sb_error *err);
json_t *sb_wire_pack_sample(const struct sb_sample *sample);
bool sb_wire_get_sample(const json_t *json, struct sb_sample *sample,
                        struct sb_error *err);
// The driver's words go into the payload.
void sb_wire_put_prepared(const struct sb_prepared *prepared, struct sb_frame *frame);
bool sb_wire_get_prepared(const struct sb_frame *frame, struct sb_prepared *prepared,
                          struct sb_error *err);
void sb_wire_put_image(const struct sb_image *image, struct sb_frame *frame);
bool sb_wire_get_image(const struct sb_frame *frame, struct sb_image *image,
                       struct sb_error *err);
