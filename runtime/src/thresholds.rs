#![doc = include_str!("thresholds.md")]
