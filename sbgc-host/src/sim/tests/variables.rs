//! Adjustable variables and variables for debugging.

use sbgc_proto::CommandId;
use sbgc_proto::commands::{
    AdjVarsVal, AdjustableVariable, Confirm, DebugVarValue, DebugVars3, DebugVars3ExtendedRequest,
    DebugVars3Request, DebugVarsInfo3, DebugVarsInfo3ExtendedRequest, DebugVarsInfo3Request, GetAdjVarsVal,
    ResetRequest, SaveParams3Extended, SetAdjVarsVal, VariableValue,
};

use super::{Bench, ms};
use crate::sim::Config;

fn values(bench: &mut Bench, ids: &[u8]) -> Vec<i32> {
    let param_id = ids.iter().map(|id| AdjustableVariable::from(*id)).collect();
    let got = bench.ask_one(&GetAdjVarsVal { param_id });
    got.decoded::<AdjVarsVal>().params.iter().map(|value| value.param_value).collect()
}

fn set(values: &[(u8, i32)]) -> SetAdjVarsVal {
    let value =
        |(id, param_value): &(u8, i32)| VariableValue { param_id: (*id).into(), param_value: *param_value };
    SetAdjVarsVal(AdjVarsVal { params: values.iter().map(value).collect() })
}

#[test]
fn variables_keep_what_is_in_their_range() {
    let mut bench = Bench::new(Config::default());
    let got = bench.ask_one(&set(&[(0, 42), (1, 7)]));
    assert_eq!(got.decoded::<Confirm>().cmd_id, CommandId::SetAdjVarsVal);
    assert_eq!(values(&mut bench, &[1, 0, 2]), [7, 42, 40]);
    // The gains of a PID end at 255; nothing is set if one is wrong.
    assert_eq!(bench.ask_one(&set(&[(0, 1), (1, 256)])).payload[..2], [31, 2]);
    assert_eq!(values(&mut bench, &[0, 1]), [42, 7]);
    assert_eq!(bench.ask_one(&set(&[(255, 1)])).payload[..2], [31, 2]);

    bench.ask_one(&SaveParams3Extended { adj_var_id: [AdjustableVariable::from(1)].into_iter().collect() });
    bench.send(&ResetRequest {});
    bench.run(ms(400));
    assert_eq!(values(&mut bench, &[0, 1]), [30, 7]);
}

#[test]
fn debug_variables_describe_themselves() {
    let mut bench = Bench::new(Config::default());
    let got = bench.ask_one(&DebugVarsInfo3Request {});
    let info = got.decoded::<DebugVarsInfo3<'_>>();
    assert_eq!((info.debug_vars_num, info.vars.len()), (8, 8));
    let kinds: Vec<_> = info.vars.iter().map(|var| var.var_type).collect();
    let values = bench.ask_one(&DebugVars3Request {});
    let values = values.decoded::<DebugVars3<'_>>().values(kinds.clone()).map(Result::unwrap);
    assert_eq!(values.map(DebugVarValue::to_f64).collect::<Vec<_>>(), [800.0, 1.0, 0., 0., 0., 0., 0., 0.]);

    let got = bench.ask_one(&DebugVarsInfo3ExtendedRequest { start_idx: 8 });
    assert_eq!(got.decoded::<DebugVarsInfo3<'_>>().debug_vars_num, 0);
    let got = bench.ask_one(&DebugVars3ExtendedRequest::new([1]).unwrap());
    assert_eq!(got.payload, [2, 0, 0, 0, 1]);
}
