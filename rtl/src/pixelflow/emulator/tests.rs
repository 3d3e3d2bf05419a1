//! Against the model by controls, which tells what the hardware does.

use proptest::prelude::*;

use super::super::{model, testing};
use super::*;

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn instructions_do_what_their_controls_do(
        program in prop::collection::vec(testing::instructions(), 1..30),
        at in [0..128_u32, 0..64_u32],
        memory in prop::collection::vec(any::<u8>(), 32),
    ) {
        let mut pixel = Pixel::new();
        pixel.memory.iter_mut().zip(memory.iter().cycle()).for_each(|(byte, value)| *byte = *value);
        let mut expected = model::Pixel::new(8);
        expected.memory = pixel.memory.iter().map(|byte| u64::from(*byte)).collect();
        for instruction in &program {
            pixel.run(std::slice::from_ref(instruction), at[0], at[1]);
            let [a, b, c] = [instruction.a, instruction.b, instruction.c].map(model::signed);
            expected.run(instruction, a * i128::from(at[0]) + b * i128::from(at[1]) + c);
        }
        let memory: Vec<u64> = pixel.memory.iter().map(|byte| u64::from(*byte)).collect();
        let enable: Vec<u64> = (0..8).map(|flag| u64::from(pixel.enable >> flag & 1)).collect();
        prop_assert_eq!(memory, expected.memory);
        prop_assert_eq!(enable, expected.enable);
        prop_assert_eq!(u64::from(pixel.accumulator), expected.accumulator);
        prop_assert_eq!([pixel.carry, pixel.flag].map(u64::from), [expected.carry, expected.flag]);
    }
}
