//! Auxiliary motors, which the firmware calls external: seven that are moved one by one.

use std::time::Duration;

use sbgc_proto::commands::{ExtMotorControlMode, ExtMotorPower};

/// How many there are.
pub(super) const AUX_MOTORS: usize = 7;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AuxMotor {
    pub(super) power: ExtMotorPower,
    pub(super) mode: ExtMotorControlMode,
    /// Degrees over many turns, and degrees per second.
    pub(super) angle: f64,
    pub(super) speed: f64,
    pub(super) angle_setpoint: f64,
    pub(super) speed_setpoint: f64,
    pub(super) torque_setpoint: i16,
    pub(super) max_speed: u16,
    pub(super) max_acceleration: u16,
    pub(super) jerk_slope: u16,
    pub(super) max_torque: u16,
}

impl AuxMotor {
    fn new() -> Self {
        Self {
            power: ExtMotorPower::OffFloating,
            mode: ExtMotorControlMode::Position,
            angle: 0.0,
            speed: 0.0,
            angle_setpoint: 0.0,
            speed_setpoint: 0.0,
            torque_setpoint: 0,
            max_speed: 90,
            max_acceleration: 360,
            jerk_slope: 0,
            max_torque: 10_000,
        }
    }

    fn is_on(&self) -> bool {
        self.power == ExtMotorPower::On
    }

    /// Moves on by this time. Acceleration is not simulated.
    fn step(&mut self, seconds: f64) {
        let most = f64::from(self.max_speed);
        self.speed = match self.mode {
            _ if !self.is_on() => 0.0,
            ExtMotorControlMode::Position => {
                let way = self.angle_setpoint - self.angle;
                (way / seconds.max(1e-6)).clamp(-most, most)
            }
            ExtMotorControlMode::Speed => self.speed_setpoint.clamp(-most, most),
            _ => 0.0,
        };
        self.angle += self.speed * seconds;
    }
}

#[derive(Debug)]
pub(super) struct AuxMotors {
    pub(super) motors: [AuxMotor; AUX_MOTORS],
    now: Duration,
}

impl AuxMotors {
    pub(super) fn new() -> Self {
        Self { motors: [AuxMotor::new(); AUX_MOTORS], now: Duration::ZERO }
    }

    /// Moves on to `now`.
    pub(super) fn advance(&mut self, now: Duration) {
        let seconds = now.saturating_sub(self.now).as_secs_f64();
        self.now = now.max(self.now);
        for motor in &mut self.motors {
            motor.step(seconds);
        }
    }

    pub(super) fn reset(&mut self) {
        self.motors = [AuxMotor::new(); AUX_MOTORS];
    }
}
