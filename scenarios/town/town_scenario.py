"""The town's scenario: a way through it among traffic, and the phases of its lights."""
from xml.sax.saxutils import quoteattr

from town_plan import WAY

# Phases of a crossing with two groups: seconds, what the first group shows, whether walkers with it go; then the same for the second.
GREEN, WALK, AMBER, CLEAR, READY = 20, 10, 3, 3, 1
HALF_TURN = [(WALK, "green", True), (GREEN - WALK, "green", False), (AMBER, "amber", False), (CLEAR, "red", False), (READY, None, False)]
PHASES = [("row", 0), ("column", 1)]
VEHICLE = """    <ScenarioObject name="ego">
      <Vehicle name="volvo-s80" vehicleCategory="car" role="civil" mass="1677">
        <BoundingBox>
          <Center x="1.311" y="0" z="0.7175"/>
          <Dimensions width="1.831" length="4.822" height="1.435"/>
        </BoundingBox>
        <Performance maxSpeed="62.6" maxAcceleration="4" maxDeceleration="9"/>
        <Axles>
          <FrontAxle maxSteering="0.61" wheelDiameter="0.642" trackWidth="1.57" positionX="2.791" positionZ="0.321"/>
          <RearAxle maxSteering="0" wheelDiameter="0.642" trackWidth="1.57" positionX="0" positionZ="0.321"/>
        </Axles>
      </Vehicle>
    </ScenarioObject>
"""
HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<!-- Written by make_town.py; change that and run it again. -->
<OpenSCENARIO>
  <FileHeader revMajor="1" revMinor="3" date="2026-11-27T12:00:00" author="Septet" description="A town: lights, priority roads, zones of 30, a station square and a roundabout"/>
  <ParameterDeclarations>
    <ParameterDeclaration name="ego_speed" parameterType="double" value="0">
      <ConstraintGroup>
        <ValueConstraint rule="greaterOrEqual" value="0"/>
        <ValueConstraint rule="lessOrEqual" value="20"/>
      </ConstraintGroup>
    </ParameterDeclaration>
    <ParameterDeclaration name="start_s" parameterType="double" value="20">
      <ConstraintGroup>
        <ValueConstraint rule="greaterOrEqual" value="0"/>
        <ValueConstraint rule="lessOrEqual" value="220"/>
      </ConstraintGroup>
    </ParameterDeclaration>
    <ParameterDeclaration name="vehicles" parameterType="unsignedInt" value="60"/>
    <ParameterDeclaration name="people" parameterType="unsignedInt" value="120">
      <ConstraintGroup>
        <ValueConstraint rule="lessOrEqual" value="1000"/>
      </ConstraintGroup>
    </ParameterDeclaration>
  </ParameterDeclarations>
  <CatalogLocations/>
  <RoadNetwork>
    <LogicFile filepath="town.xodr"/>
    <TrafficSignals>
"""
BODY = """    </TrafficSignals>
  </RoadNetwork>
  <Entities>
{vehicle}  </Entities>
  <Storyboard>
    <Init>
      <Actions>
        <GlobalAction>
          <EnvironmentAction>
            <Environment name="afternoon with some clouds">
              <TimeOfDay animation="false" dateTime="2026-05-21T15:30:00"/>
              <Weather fractionalCloudCover="threeOktas" temperature="290.15">
                <Sun azimuth="3.9" elevation="0.8" illuminance="80000"/>
                <Fog visualRange="15000"/>
                <Precipitation precipitationType="dry" precipitationIntensity="0"/>
                <Wind direction="0.6" speed="2"/>
              </Weather>
              <RoadCondition frictionScaleFactor="1" wetness="dry"/>
            </Environment>
          </EnvironmentAction>
        </GlobalAction>
        <GlobalAction>
          <TrafficAction trafficName="town traffic">
            <TrafficSwarmAction innerRadius="30" semiMajorAxis="400" semiMinorAxis="400" offset="0" numberOfVehicles="$vehicles">
              <CentralObject entityRef="ego"/>
              <TrafficDefinition name="town by day">
                <VehicleCategoryDistribution>
                  <VehicleCategoryDistributionEntry category="car" weight="0.86"/>
                  <VehicleCategoryDistributionEntry category="van" weight="0.1"/>
                  <VehicleCategoryDistributionEntry category="truck" weight="0.04"/>
                </VehicleCategoryDistribution>
                <ControllerDistribution>
                  <ControllerDistributionEntry weight="1">
                    <Controller name="septet-traffic" controllerType="movement">
                      <Properties/>
                    </Controller>
                  </ControllerDistributionEntry>
                </ControllerDistribution>
              </TrafficDefinition>
              <DirectionOfTravelDistribution same="0.5" opposite="0.5"/>
            </TrafficSwarmAction>
          </TrafficAction>
        </GlobalAction>
        <UserDefinedAction>
          <CustomCommandAction type="septet:people">count=$people radius_m=250</CustomCommandAction>
        </UserDefinedAction>
        <Private entityRef="ego">
          <PrivateAction>
            <TeleportAction>
              <Position>
                <LanePosition roadId="{first}" laneId="-1" s="$start_s" offset="0"/>
              </Position>
            </TeleportAction>
          </PrivateAction>
          <PrivateAction>
            <LongitudinalAction>
              <SpeedAction>
                <SpeedActionDynamics dynamicsShape="step" dynamicsDimension="time" value="0"/>
                <SpeedActionTarget>
                  <AbsoluteTargetSpeed value="$ego_speed"/>
                </SpeedActionTarget>
              </SpeedAction>
            </LongitudinalAction>
          </PrivateAction>
        </Private>
      </Actions>
    </Init>
    <StopTrigger>
      <ConditionGroup>
        <Condition name="out of the town" delay="0" conditionEdge="none">
          <ByEntityCondition>
            <TriggeringEntities triggeringEntitiesRule="any">
              <EntityRef entityRef="ego"/>
            </TriggeringEntities>
            <EntityCondition>
              <ReachPositionCondition tolerance="10">
                <Position>
                  <LanePosition roadId="{last}" laneId="1" s="40" offset="0"/>
                </Position>
              </ReachPositionCondition>
            </EntityCondition>
          </ByEntityCondition>
        </Condition>
      </ConditionGroup>
      <ConditionGroup>
        <Condition name="half an hour" delay="0" conditionEdge="none">
          <ByValueCondition>
            <SimulationTimeCondition value="1800" rule="greaterOrEqual"/>
          </ByValueCondition>
        </Condition>
      </ConditionGroup>
    </StopTrigger>
  </Storyboard>
</OpenSCENARIO>
"""


def phases(heads):
    """One turn of a crossing's lights: (name, seconds, [(signal, state)])."""
    for name, goes in PHASES:
        for number, (seconds, shows, walk) in enumerate(HALF_TURN):
            states = []
            for signal, group, walkers in heads:
                if walkers:
                    state = "green" if walk and group == goes else "red"
                elif shows is None:
                    state = "red" if group == goes else "red-amber"
                else:
                    state = shows if group == goes else "red"
                states.append((signal, state))
            yield f"{name} {('goes, walkers too', 'goes', 'clears', 'is clear', 'has been')[number]}", seconds, states


def scenario(town):
    text = [HEAD]
    for _, name, heads in town.lights:
        text.append(f"      <TrafficSignalController name={quoteattr(name)}>\n")
        for phase, seconds, states in phases(heads):
            text.append(f'        <Phase name="{phase}" duration="{seconds}">\n')
            text += [f'          <TrafficSignalState trafficSignalId="{signal}" state="{state}"/>\n' for signal, state in states]
            text.append("        </Phase>\n")
        text.append("      </TrafficSignalController>\n")
    of_entry = {street.a: number for street, number in town.numbers.items() if isinstance(street.a, str)}
    text.append(BODY.format(vehicle=VEHICLE, first=of_entry[WAY[0]], last=of_entry[WAY[-1]]))
    return "".join(text)
