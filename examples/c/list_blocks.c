/* Lists all block types with their ports and parameters: what an editor needs to show them.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */
#include <stdio.h>
#include <stdlib.h>

#include <ptlib/ptlib.h>

static const char *kind_name(uint32_t kind)
{
    switch (kind) {
    case PTL_KIND_IMAGE: return "image";
    case PTL_KIND_GRADIENT: return "gradient";
    case PTL_KIND_TEXT: return "text";
    case PTL_KIND_POINTS: return "points";
    case PTL_KIND_MESH: return "mesh";
    case PTL_KIND_STRANDS: return "strands";
    default: return "unknown kind";
    }
}

static void print_ports(const ptl_block_type *type)
{
    ptl_port_info port;
    uint32_t i;
    port.struct_size = sizeof port;
    for (i = 0; i < ptl_block_type_input_count(type); i++) {
        if (ptl_block_type_input_info(type, i, &port) == PTL_OK) {
            printf("    takes %s: %s%s\n", port.id, kind_name(port.kind),
                   (port.flags & PTL_PORT_OPTIONAL) != 0 ? " (optional)" : "");
        }
    }
    for (i = 0; i < ptl_block_type_output_count(type); i++) {
        if (ptl_block_type_output_info(type, i, &port) == PTL_OK) {
            printf("    gives %s: %s\n", port.id, kind_name(port.kind));
        }
    }
}

static void print_params(const ptl_block_type *type)
{
    ptl_param_info param;
    uint32_t i, k;
    param.struct_size = sizeof param;
    for (i = 0; i < ptl_block_type_param_count(type); i++) {
        if (ptl_block_type_param_info(type, i, &param) != PTL_OK) continue;
        printf("    %s = %s", param.id, param.default_text);
        if (param.type == PTL_PARAM_INT || param.type == PTL_PARAM_FLOAT) {
            printf(" (%g to %g)%s%s", param.min, param.max, *param.unit != '\0' ? " " : "",
                   param.unit);
        }
        printf("\n        %s\n", param.doc);
        for (k = 0; k < param.enum_count; k++) {
            printf("        %s: %s\n", param.enum_ids[k], param.enum_docs[k]);
        }
    }
}

int main(void)
{
    ptl_engine *engine = NULL;
    ptl_error *error = NULL;
    uint32_t i;

    if (ptl_engine_create(NULL, &engine, &error) != PTL_OK) {
        fprintf(stderr, "%s\n", ptl_error_message(error));
        ptl_error_release(error);
        return EXIT_FAILURE;
    }
    printf("ptlib %s\n", ptl_version_string());
    for (i = 0; i < ptl_engine_block_type_count(engine); i++) {
        const ptl_block_type *type = ptl_engine_block_type_at(engine, i);
        printf("\n%s / %s: %s\n", ptl_block_type_category(type), ptl_block_type_id(type),
               ptl_block_type_doc(type));
        print_ports(type);
        print_params(type);
    }
    ptl_engine_release(engine);
    return EXIT_SUCCESS;
}
